// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_spread_mesh_h
#define hpvi_spread_mesh_h

#include <hpvi/space/moment_space.h>

#include <memory>

namespace hpvi
{
/** The coarse mesh of @p scene over all processes. Throws InputError where it has fewer cells, or the path refuses the scene. Collective. */
template <int dim>
std::shared_ptr<typename MomentSpace<dim>::Mesh> spread_mesh(const Scene<dim> &scene,
                                                             MPI_Comm communicator);
} // namespace hpvi

#endif
