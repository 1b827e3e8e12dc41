// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_element_checks_h
#define hpvi_element_checks_h

#include <hpvi/reader/gmsh/gmsh_file.h>
#include <hpvi/reader/gmsh/mesh_complaint.h>
#include <hpvi/scene/coarse_mesh.h>

namespace hpvi
{
/**
 * Throws InputError unless there are cells, and these are triangles or quadrilaterals in physical surfaces.
 */
void check_elements(const GmshFile &file, const MeshComplaint &complain);

/** The largest extent of all vertices. Throws InputError unless it is between 1e-100 and 1e100. */
double size_of(const CoarseMesh &mesh, const MeshComplaint &complain);

/** Throws InputError where two vertices are nearer than 1e-12 of @p size; @p nodes are those of vertices. */
void check_places(const GmshFile &file, const CoarseMesh &mesh,
                  const std::vector<unsigned int> &nodes, double size,
                  const MeshComplaint &complain);
} // namespace hpvi

#endif
