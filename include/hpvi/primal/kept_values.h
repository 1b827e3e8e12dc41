// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_kept_values_h
#define hpvi_kept_values_h

#include <hpvi/moments/moment_space.h>

#include <deal.II/lac/vector.h>

#include <vector>

namespace hpvi
{
/**
 * u and lambda cell by cell, as run states keep them. Cells are counted along the curve that p4est orders them by, however many
 * processes share them.
 */
struct KeptValues
{
  dealii::Vector<double> u, lambda;
};

/** Of all processes. Collective, as the next. */
template <int dim>
KeptValues kept_values(const MomentSpace<dim> &space, const DistributedVector &u,
                       const std::vector<ContactVector<dim>> &lambda);

/** Into @p u and @p lambda; false where these are no values of the mesh. */
template <int dim>
bool take_kept(const KeptValues &values, const MomentSpace<dim> &space, DistributedVector &u,
               std::vector<ContactVector<dim>> &lambda);
} // namespace hpvi

#endif
