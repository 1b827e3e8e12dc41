// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_words_h
#define hpvi_mesh_words_h

#include <hpvi/scene/hexahedral_mesh.h>

#include <string>
#include <vector>

namespace hpvi
{
/** Of each boundary the number of its edges and its length, of curves of a drawing their ends, too. */
std::vector<std::string> boundaries_in_words(const CoarseMesh &mesh,
                                             const std::string &length_unit);

/**
 * What a mesh holds, a line each: numbers of cells and vertices, the largest angle of a corner; of each boundary and
 * curve inside edges and length, of each surface cells and area, curves taken as they are.
 */
std::vector<std::string> mesh_words(const CoarseMesh &mesh, const std::string &length_unit);

/** Likewise of hexahedra: its faces and volumes. */
std::vector<std::string> mesh_words(const HexahedralMesh &mesh, const std::string &length_unit);
} // namespace hpvi

#endif
