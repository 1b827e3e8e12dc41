// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_texts_h
#define hpvi_mesh_texts_h

#include <hpvi/reader/gmsh/mesh_file.h>

#include <string>

/** Two squares side by side, one of them clockwise, in the formats 2.2, 4.0 and 4.1; nodes that no cell has. */
extern const std::string two_squares_22, two_squares_40, two_squares_41;

/** A cell of second order on (0,2)x(0,1), of which the bottom is a parabola; with nine nodes, and with eight. */
extern const std::string curved_cell_22, curved_cell_41;

/** With @p to in the place of @p from, which must be there once. */
std::string replaced(const std::string &text, const std::string &from, const std::string &to);

std::string replaced_all(std::string text, const std::string &from, const std::string &to);

/** The body in a file of this text. */
hpvi::CoarseMesh read_text(const std::string &text);

/** Of the InputError that a file of this text meets; empty: none. */
std::string message_of(const std::string &text);

#endif
