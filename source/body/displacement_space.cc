// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/edge_constraints.h>
#include <hpvi/body/supports.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

template <int dim>
DisplacementSpace<dim>::DisplacementSpace(const Scene<dim> &scene,
                                          const Triangulation<dim> &triangulation,
                                          const Degrees &degrees, const ShapeTables<dim> &tables)
    : cell_degrees(degrees), dofs(triangulation)
{
  for (const auto &cell : dofs.active_cell_iterators())
    if (cell->is_locally_owned())
      cell->set_active_fe_index(degrees[cell->active_cell_index()] - 1);
  dofs.distribute_dofs(tables.elements(*std::max_element(degrees.begin(), degrees.end())));

  store_cell_dofs();
  make_constraints(scene, tables);
}

template <int dim>
void DisplacementSpace<dim>::make_constraints(const Scene<dim> &scene,
                                              const ShapeTables<dim> &tables)
{
  constrain_hanging_nodes(*this, tables, affine_constraints);

  constrain_supports(supported_nodes(scene, *this, tables), affine_constraints);
  affine_constraints.close();
}

template <int dim>
void DisplacementSpace<dim>::store_cell_dofs()
{
  const unsigned int n_cells = triangulation().n_active_cells();
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
const Triangulation<dim> &DisplacementSpace<dim>::triangulation() const
{
  return dofs.get_triangulation();
}

template <int dim>
const DoFHandler<dim> &DisplacementSpace<dim>::dof_handler() const
{
  return dofs;
}

template <int dim>
const AffineConstraints<double> &DisplacementSpace<dim>::constraints() const
{
  return affine_constraints;
}

template <int dim>
const Degrees &DisplacementSpace<dim>::degrees() const
{
  return cell_degrees;
}

template <int dim>
unsigned int DisplacementSpace<dim>::n_dofs() const
{
  return dofs.n_dofs();
}

template <int dim>
unsigned int DisplacementSpace<dim>::n_free_dofs() const
{
  return dofs.n_dofs() - affine_constraints.n_constraints();
}

template <int dim>
ArrayView<const types::global_dof_index>
DisplacementSpace<dim>::cell_dofs(const unsigned int cell) const
{
  return {stored_dofs.data() + first_stored_dof[cell],
          first_stored_dof[cell + 1] - first_stored_dof[cell]};
}

template class DisplacementSpace<2>;
} // namespace hpvi
