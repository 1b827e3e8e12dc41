// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_load_work_h
#define hpvi_load_work_h

#include <hpvi/space/primal_space.h>

namespace hpvi
{
/**
 * `L(u)` [stress length^dim] of the loads of @p scene, on the body of @p space, by @p finer times the p + 1 Gauss
 * points a direction on each cell and face that the path itself takes. Collective.
 */
template <int dim>
double load_work(const Scene<dim> &scene, const PrimalSpace<dim> &space, const DistributedVector &u,
                 unsigned int finer);
} // namespace hpvi

#endif
