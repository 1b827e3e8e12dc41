// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/cell_map.h>
#include <hpvi/results/unseen_contact.h>
#include <hpvi/results/warnings/body_state.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace hpvi
{
using namespace dealii;

template <int dim>
BodyState<dim> body_state(const Field<dim> &field)
{
  BodyState<dim> state;
  state.displacement = field.largest_displacement();
  state.deformation = deformation(field);
  state.gradients = mean_gradients(field);
  state.degrees.assign(field.scene.materials.size(), std::numeric_limits<unsigned int>::max());
  for (const auto &cell : field.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    unsigned int &lowest = state.degrees[cell->material_id()];
    lowest = std::min(lowest, field.degree(cell));
    const CellMap<dim> map = map_of<dim>(cell);
    const double ratio = map.longest_edge() / map.shortest_edge();
    if (ratio > state.elongation)
    {
      state.elongation = ratio;
      state.elongated = cell->center();
    }
  }
  for (const auto &[ratio, centre] : Utilities::MPI::all_gather(
           field.communicator(), std::make_pair(state.elongation, state.elongated)))
    if (ratio > state.elongation)
    {
      state.elongation = ratio;
      state.elongated = centre;
    }
  for (unsigned int &lowest : state.degrees)
    lowest = Utilities::MPI::min(lowest, field.communicator());
  return state;
}

template BodyState<2> body_state(const Field<2> &);
template BodyState<3> body_state(const Field<3> &);
} // namespace hpvi
