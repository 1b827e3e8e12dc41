// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_quadrilaterals_h
#define hpvi_quadrilaterals_h

#include <hpvi/reader/gmsh/gmsh_file.h>
#include <hpvi/reader/gmsh/mesh_complaint.h>

namespace hpvi
{
/**
 * Cut cells into quadrilaterals wherever a mesh that hangs together by edges has a triangle, or a corner of 180 degrees
 * between two edges of one smooth curve: by the middles of edges, on their curves, and points inside, so that neighbours match. A
 * triangle makes three, a quadrilateral four, one with such a corner six, as two triangles, and a triangle with such a corner five.
 * GmshFile::remarks tells of it. Other meshes stay as they are.
 */
void make_quadrilaterals(GmshFile &file, const MeshComplaint &complain);
} // namespace hpvi

#endif
