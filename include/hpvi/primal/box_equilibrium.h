// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_equilibrium_h
#define hpvi_box_equilibrium_h

#include <hpvi/evaluation/equilibrium.h>
#include <hpvi/moments/primal_system.h>

#include <vector>

namespace hpvi
{
/**
 * equilibrium() on a distributed mesh of boxes: the same forces by boundary from nodal reactions,
 * their sums over all processes. Collective.
 */
template <int dim>
Equilibrium<dim> equilibrium(const MomentSpace<dim> &space, const PrimalSystem<dim> &system,
                             const DistributedVector &u,
                             const std::vector<ContactVector<dim>> &lambda);
} // namespace hpvi

#endif
