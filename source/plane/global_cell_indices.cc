// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/global_cell_indices.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria_base.h>
#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace hpvi
{
using namespace dealii;

template <int dim>
std::vector<types::global_cell_index> global_cell_indices(const Triangulation<dim> &mesh)
{
  std::vector<types::global_cell_index> ranks(mesh.n_active_cells());
  std::iota(ranks.begin(), ranks.end(), types::global_cell_index());
  const auto *const shared = dynamic_cast<const parallel::TriangulationBase<dim> *>(&mesh);
  if (!shared)
    return ranks;
  MPI_Comm communicator = shared->get_communicator();
  std::vector<std::pair<CellId, unsigned int>> own;
  for (const auto &cell : mesh.active_cell_iterators())
    if (cell->is_locally_owned())
      own.emplace_back(cell->id(), cell->active_cell_index());
  std::sort(own.begin(), own.end());
  // The curve of p4est visits the descendants of a coarse cell child by child, and the processes in their order.
  const unsigned int n_coarse = shared->n_global_coarse_cells();
  std::vector<unsigned int> count(n_coarse), before(n_coarse), all(n_coarse);
  for (const auto &cell : own)
    ++count[cell.first.get_coarse_cell_id()];
  MPI_Exscan(count.data(), before.data(), n_coarse, MPI_UNSIGNED, MPI_SUM, communicator);
  if (Utilities::MPI::this_mpi_process(communicator) == 0) // for which that leaves anything
    std::fill(before.begin(), before.end(), 0);
  Utilities::MPI::sum(count, communicator, all);
  types::global_cell_index first = 0;
  auto cell = own.begin();
  for (unsigned int coarse = 0; coarse < n_coarse; ++coarse)
  {
    for (auto next = first + before[coarse];
         cell != own.end() && cell->first.get_coarse_cell_id() == coarse; ++cell)
      ranks[cell->second] = next++;
    first += all[coarse];
  }
  return ranks;
}

template std::vector<types::global_cell_index> global_cell_indices(const Triangulation<2> &);
template std::vector<types::global_cell_index> global_cell_indices(const Triangulation<3> &);
} // namespace hpvi
