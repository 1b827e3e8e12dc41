// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_from_file_h
#define hpvi_mesh_from_file_h

#include <hpvi/reader/gmsh/drawing_file.h>
#include <hpvi/reader/shapes/shape.h>

namespace hpvi
{
/** The mesh of a drawing or a mesh file (read_mesh_file()), for the list of shapes(). */
ShapeKind<2> mesh_from_file();

/** What a section says of a drawing, by the texts of its entries, and the entries. */
DrawingRequest drawing_request(const GeometryText &text);
std::vector<Entry> drawing_entries(unsigned int dim);

std::vector<std::string> words_in(const std::string &list); ///< between commas

/** `Surfaces` of a body: those of its file, volumes in space, that make it; empty: all. */
std::vector<std::string> surfaces_of_body(const Parameters &parameters);

/** What a body takes is in the file; @p reject is told what is not. */
void check_surfaces(const std::vector<std::string> &wanted, const CoarseMesh &mesh,
                    const std::function<void(const std::string &)> &reject);

/** Where a scene file @p scene finds the file that it calls @p name: beside itself, unless that is a whole path. */
std::string beside(const std::string &scene, const std::string &name);

/** Of a boundary, or an interface of a mesh: what its edges follow, and of which curves it consists. */
std::vector<Entry> curve_entries(const std::string &name);

/** Throws InputError where no boundary has a name; @p kind: curve or surface. */
void require_names(const std::vector<std::string> &boundaries, const std::string &file,
                   const std::string &kind);

/** Lines for users about boundaries that are polygons where circles might be meant. */
std::vector<std::string> remarks_on_polygons(const CoarseMesh &mesh);
} // namespace hpvi

#endif
