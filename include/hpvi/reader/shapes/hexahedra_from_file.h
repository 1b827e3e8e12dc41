// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_hexahedra_from_file_h
#define hpvi_hexahedra_from_file_h

#include <hpvi/reader/shapes/shape.h>
#include <hpvi/scene/hexahedral_mesh.h>

namespace hpvi
{
/** The mesh of a file of Gmsh in space (read_hexahedral_file()), for the list of shapes(). */
ShapeKind<3> hexahedra_from_file();

/** Lines for users about boundaries of plane faces where cylinders might be meant. */
std::vector<std::string> remarks_on_facets(const HexahedralMesh &mesh);
} // namespace hpvi

#endif
