// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/primal/cell_numbers.h>
#include <hpvi/primal/kept_values.h>
#include <hpvi/primal/transfer.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
KeptValues kept_values(const MomentSpace<dim> &space, const DistributedVector &u,
                       const std::vector<ContactVector<dim>> &lambda)
{
  CellNumbers own_u, own_z;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const CellValues values = values_on(cell, space, u, lambda);
      own_u.emplace_back(cell->global_active_cell_index(), values.u);
      own_z.emplace_back(cell->global_active_cell_index(), values.lambda);
    }
  const unsigned int n_cells = space.dof_handler.get_triangulation().n_global_active_cells();
  const auto joined = [&](const CellNumbers &own)
  {
    std::vector<double> all;
    for (const auto &numbers : join_cells(own, n_cells, space.communicator()))
      all.insert(all.end(), numbers.begin(), numbers.end());
    return Vector<double>(all.begin(), all.end());
  };
  return {joined(own_u), joined(own_z)};
}

template <int dim>
bool take_kept(const KeptValues &values, const MomentSpace<dim> &space, DistributedVector &u,
               std::vector<ContactVector<dim>> &lambda)
{
  const unsigned int n = space.tables.fe.dofs_per_cell,
                     n_cells = space.dof_handler.get_triangulation().n_global_active_cells();
  u = space.ghosted_vector();
  lambda.assign(space.contact.size(), ContactVector<dim>());
  CellNumbers sizes; // of the multiplier
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      sizes.emplace_back(cell->global_active_cell_index(),
                         std::vector<double>(1, values_on(cell, space, u, lambda).lambda.size()));
  std::vector<std::size_t> first(1, 0);
  for (const auto &size : join_cells(sizes, n_cells, space.communicator()))
    first.push_back(first.back() + size.front());
  if (values.u.size() != n * n_cells || values.lambda.size() != first.back())
    return false;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const auto k = cell->global_active_cell_index();
      take_values<dim>(cell,
                       {{values.u.begin() + n * k, values.u.begin() + n * (k + 1)},
                        {values.lambda.begin() + first[k], values.lambda.begin() + first[k + 1]}},
                       space, u, lambda);
    }
  u.zero_out_ghost_values();
  u.update_ghost_values();
  return true;
}

template KeptValues kept_values(const MomentSpace<2> &, const DistributedVector &,
                                const std::vector<ContactVector<2>> &);
template KeptValues kept_values(const MomentSpace<3> &, const DistributedVector &,
                                const std::vector<ContactVector<3>> &);
template bool take_kept(const KeptValues &, const MomentSpace<2> &, DistributedVector &,
                        std::vector<ContactVector<2>> &);
template bool take_kept(const KeptValues &, const MomentSpace<3> &, DistributedVector &,
                        std::vector<ContactVector<3>> &);
} // namespace hpvi
