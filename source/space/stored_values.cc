// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/gathered.h>
#include <hpvi/plane/global_cell_indices.h>
#include <hpvi/space/stored_values.h>
#include <hpvi/space/transfer.h>

#include <deal.II/base/mpi.h>

#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Numbers of cells of this process, by global_cell_indices(). */
using CellNumbers = std::vector<std::pair<types::global_cell_index, std::vector<double>>>;

/** Those of all @p n_cells cells of all processes. Collective. */
std::vector<std::vector<double>> join_cells(const CellNumbers &own, const unsigned int n_cells,
                                            MPI_Comm communicator)
{
  std::vector<double> records; // the cell, how many numbers it has, and these
  for (const auto &[cell, numbers] : own)
  {
    records.push_back(static_cast<double>(cell));
    records.push_back(static_cast<double>(numbers.size()));
    records.insert(records.end(), numbers.begin(), numbers.end());
  }
  const std::vector<double> all = gathered(records, communicator);
  std::vector<std::vector<double>> result(n_cells);
  for (auto record = all.begin(); record != all.end();)
  {
    const auto numbers = record + 2, end = numbers + static_cast<std::ptrdiff_t>(record[1]);
    result[static_cast<std::size_t>(record[0])].assign(numbers, end);
    record = end;
  }
  return result;
}

template <int dim>
unsigned int n_cells(const PrimalSpace<dim> &space)
{
  return space.dof_handler.get_triangulation().n_global_active_cells();
}
} // namespace

template <int dim>
StoredValues stored_values(const PrimalSpace<dim> &space, const DistributedVector &u,
                           const std::vector<ContactVector<dim>> &lambda)
{
  const auto ranks = global_cell_indices(space.dof_handler.get_triangulation());
  CellNumbers own_u, own_z;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const CellValues values = values_on(cell, space, u, lambda);
      own_u.emplace_back(ranks[cell->active_cell_index()], values.u);
      own_z.emplace_back(ranks[cell->active_cell_index()], values.lambda);
    }
  const auto joined = [&space](const CellNumbers &own)
  {
    std::vector<double> all;
    for (const auto &numbers : join_cells(own, n_cells(space), space.communicator()))
      all.insert(all.end(), numbers.begin(), numbers.end());
    return Vector<double>(all.begin(), all.end());
  };
  return {joined(own_u), joined(own_z)};
}

template <int dim>
bool take_stored(const Vector<double> &stored_u, const Vector<double> &stored_z,
                 const PrimalSpace<dim> &space, DistributedVector &u,
                 std::vector<ContactVector<dim>> &lambda)
{
  const auto ranks = global_cell_indices(space.dof_handler.get_triangulation());
  u = space.ghosted_vector();
  lambda.assign(space.contact.size(), ContactVector<dim>());
  CellNumbers sizes; // of u and the multiplier
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      sizes.emplace_back(
          ranks[cell->active_cell_index()],
          std::vector<double>{double(space.tables.of(cell).fe.dofs_per_cell),
                              double(values_on(cell, space, u, lambda).lambda.size())});
  std::vector<std::size_t> first_u(1, 0), first_z(1, 0);
  for (const auto &size : join_cells(sizes, n_cells(space), space.communicator()))
  {
    first_u.push_back(first_u.back() + size[0]);
    first_z.push_back(first_z.back() + size[1]);
  }
  if (stored_u.size() != first_u.back() || stored_z.size() != first_z.back())
    return false;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const auto k = ranks[cell->active_cell_index()];
      take_values<dim>(cell,
                       {{stored_u.begin() + first_u[k], stored_u.begin() + first_u[k + 1]},
                        {stored_z.begin() + first_z[k], stored_z.begin() + first_z[k + 1]}},
                       space, u, lambda);
    }
  u.zero_out_ghost_values();
  u.update_ghost_values();
  return true;
}

template StoredValues stored_values(const PrimalSpace<2> &, const DistributedVector &,
                                    const std::vector<ContactVector<2>> &);
template StoredValues stored_values(const PrimalSpace<3> &, const DistributedVector &,
                                    const std::vector<ContactVector<3>> &);
template bool take_stored(const Vector<double> &, const Vector<double> &, const PrimalSpace<2> &,
                          DistributedVector &, std::vector<ContactVector<2>> &);
template bool take_stored(const Vector<double> &, const Vector<double> &, const PrimalSpace<3> &,
                          DistributedVector &, std::vector<ContactVector<3>> &);
} // namespace hpvi
