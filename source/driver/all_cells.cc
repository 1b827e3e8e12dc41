// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/driver/all_cells.h>
#include <hpvi/plane/cell_ranks.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria_base.h>

#include <utility>

namespace hpvi
{
using namespace dealii;

template <int dim>
std::vector<double> of_all_cells(const ErrorEstimate &estimate, const Field<dim> &field)
{
  const Triangulation<dim> &mesh = field.dof_handler.get_triangulation();
  if (!dynamic_cast<const parallel::TriangulationBase<dim> *>(&mesh))
    return estimate.indicators();
  const std::vector<types::global_cell_index> ranks = cell_ranks(mesh);
  std::vector<std::pair<types::global_cell_index, double>> own;
  for (const auto &cell : field.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      own.emplace_back(ranks[cell->active_cell_index()],
                       estimate.indicator(cell->active_cell_index()));
  std::vector<double> eta(mesh.n_global_active_cells());
  for (const auto &part : Utilities::MPI::all_gather(field.communicator(), own))
    for (const auto &[cell, value] : part)
      eta[cell] = value;
  return eta;
}

template std::vector<double> of_all_cells(const ErrorEstimate &, const Field<2> &);
template std::vector<double> of_all_cells(const ErrorEstimate &, const Field<3> &);
} // namespace hpvi
