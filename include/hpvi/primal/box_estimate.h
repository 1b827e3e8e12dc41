// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_estimate_h
#define hpvi_box_estimate_h

#include <hpvi/evaluation/residual_estimator.h>
#include <hpvi/moments/moment_space.h>

#include <vector>

namespace hpvi
{
/**
 * estimate_error() on a distributed mesh of boxes: the same residual indicator, for the cells of this process;
 * those of others have zeros. Local, but @p u must know its neighbours.
 */
template <int dim>
ErrorEstimate estimate_error(const MomentSpace<dim> &space, const DistributedVector &u,
                             const std::vector<ContactVector<dim>> &lambda);
} // namespace hpvi

#endif
