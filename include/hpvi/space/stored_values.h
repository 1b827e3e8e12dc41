// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stored_values_h
#define hpvi_stored_values_h

#include <hpvi/space/primal_space.h>

#include <deal.II/lac/vector.h>

#include <vector>

namespace hpvi
{
/**
 * Displacement and multiplier of the primal path cell by cell, in the order of global_cell_indices().
 */
struct StoredValues
{
  dealii::Vector<double> u, z;
};

/** Collective. */
template <int dim>
StoredValues stored_values(const PrimalSpace<dim> &space, const DistributedVector &u,
                           const std::vector<ContactVector<dim>> &lambda);

/** Sets both; false where the numbers are those of another mesh. Collective. */
template <int dim>
bool take_stored(const dealii::Vector<double> &stored_u, const dealii::Vector<double> &stored_z,
                 const PrimalSpace<dim> &space, DistributedVector &u,
                 std::vector<ContactVector<dim>> &lambda);
} // namespace hpvi

#endif
