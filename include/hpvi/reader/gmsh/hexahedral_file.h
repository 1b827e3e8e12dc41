// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_hexahedral_file_h
#define hpvi_hexahedral_file_h

#include <hpvi/reader/gmsh/drawing_file.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * The body in space in the drawing or mesh file @p path: hexahedra of first order, or what make_hexahedra() makes of other cells. Boundaries are
 * its physical surfaces and #surfaces of the mesh its physical volumes, in the order of their tags; one without a name is
 * called by its tag, and without any by their numbers. Of several @p volumes of the file, by these names, those alone are the body; empty: all. Where
 * the file has none of them there are no cells. Corners stand in an order in which the edges of all cells run the same way.
 *
 * Throws InputError of one line (file, element where it has a number, problem, remedy) for all else: a file that is missing or
 * damaged; other elements; cells that are in no group, folded, with faces that are not plane to 1e-8 of their size, or not one
 * part connected through faces; nodes twice at one place or hanging; faces in a group and of no cell, or of more
 * than two cells; a group that lies on the boundary and inside; names that a scene cannot write.
 */
HexahedralMesh read_hexahedral_file(const std::string &path,
                                    const std::vector<std::string> &volumes = {},
                                    const DrawingRequest &request = {});
} // namespace hpvi

#endif
