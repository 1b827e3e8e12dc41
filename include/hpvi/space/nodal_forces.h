// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_nodal_forces_h
#define hpvi_nodal_forces_h

#include <hpvi/results/equilibrium.h>
#include <hpvi/space/primal_system.h>

#include <vector>

namespace hpvi
{
/** Of u and lambda on a distributed mesh of boxes, for equilibrium(). Collective. */
template <int dim>
NodalForces<dim> nodal_forces(const PrimalSpace<dim> &space, const PrimalSystem<dim> &system,
                              const DistributedVector &u,
                              const std::vector<ContactVector<dim>> &lambda);
} // namespace hpvi

#endif
