// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/dof_numbering.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

template <int dim>
DofNumbering<dim>::DofNumbering(const Triangulation<dim> &triangulation, const Degrees &degrees,
                                const ShapeTables<dim> &tables)
    : cell_degrees(degrees), dofs(triangulation)
{
  for (const auto &cell : dofs.active_cell_iterators())
    if (cell->is_locally_owned())
      cell->set_active_fe_index(degrees[cell->active_cell_index()] - 1);
  dofs.distribute_dofs(tables.elements(*std::max_element(degrees.begin(), degrees.end())));
  store_cell_dofs();
}

template <int dim>
void DofNumbering<dim>::store_cell_dofs()
{
  const unsigned int n_cells = dofs.get_triangulation().n_active_cells();
  first_stored_dof.assign(1, 0);
  for (unsigned int cell = 0; cell < n_cells; ++cell)
    first_stored_dof.push_back(first_stored_dof.back() +
                               dofs.get_fe(cell_degrees[cell] - 1).n_dofs_per_cell());
  stored_dofs.resize(first_stored_dof.back());

  std::vector<types::global_dof_index> indices;
  for (const auto &cell : dofs.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      indices.resize(cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(indices);
      std::copy(indices.begin(), indices.end(),
                stored_dofs.begin() + first_stored_dof[cell->active_cell_index()]);
    }
}

template <int dim>
const DoFHandler<dim> &DofNumbering<dim>::dof_handler() const
{
  return dofs;
}

template <int dim>
const Degrees &DofNumbering<dim>::degrees() const
{
  return cell_degrees;
}

template <int dim>
ArrayView<const types::global_dof_index> DofNumbering<dim>::cell_dofs(const unsigned int cell) const
{
  return {stored_dofs.data() + first_stored_dof[cell],
          first_stored_dof[cell + 1] - first_stored_dof[cell]};
}

template class DofNumbering<2>;
} // namespace hpvi
