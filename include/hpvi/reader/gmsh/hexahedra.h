// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_hexahedra_h
#define hpvi_hexahedra_h

#include <hpvi/reader/gmsh/gmsh_file.h>

namespace hpvi
{
/**
 * Cut cells in space into hexahedra where there are tetrahedra or prisms: each corner with its edges, faces and the centre, so
 * that neighbours match. A tetrahedron makes four, a prism six and a hexahedron eight; where all are prisms that stand on each other,
 * three each, whose height stays. Faces on surfaces are cut likewise. GmshFile::remarks tells of it. Other meshes stay as they are.
 */
void make_hexahedra(GmshFile &file);
} // namespace hpvi

#endif
