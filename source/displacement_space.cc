// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/numerics/vector_tools_boundary.h>
#include <deal.II/numerics/vector_tools_constraints.h>
#include <hpvi/hanging_nodes.h>

#include <algorithm>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The vector-valued function whose components are the expressions of a scene. */
template <int dim>
class ExpressionVector : public Function<dim>
{
public:
  explicit ExpressionVector(
      const std::array<typename BoundaryCondition<dim>::Expression, dim> &components)
      : Function<dim>(dim), components(components)
  {
  }

  double value(const Point<dim> &x, const unsigned int component) const override
  {
    return components[component] ? components[component]->value(x) : 0.;
  }

  void vector_value(const Point<dim> &x, Vector<double> &values) const override
  {
    for (unsigned int c = 0; c < dim; ++c)
      values[c] = value(x, c);
  }

private:
  const std::array<typename BoundaryCondition<dim>::Expression, dim> &components;
};
} // namespace

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

  // Unknowns that are constrained already are left alone, so the order settles shared corners:
  // supports first, then the sliding condition of the contact boundary.
  std::set<types::boundary_id> contact;
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    if (boundary.bilateral_contact)
      contact.insert(boundary.id);
    if (!boundary.has_displacement())
      continue;
    ComponentMask prescribed(dim, false);
    for (unsigned int c = 0; c < dim; ++c)
      prescribed.set(c, boundary.displacement[c] != nullptr);
    VectorTools::interpolate_boundary_values(dofs, boundary.id,
                                             ExpressionVector<dim>(boundary.displacement),
                                             affine_constraints, prescribed);
  }
  if (!contact.empty())
    VectorTools::compute_no_normal_flux_constraints(dofs, 0, contact, affine_constraints);
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
