// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/contact_axes.h>
#include <hpvi/space/support_constraints.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/vector_tools_boundary.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The prescribed displacement of a boundary. */
template <int dim>
class PrescribedDisplacement : public Function<dim>
{
public:
  explicit PrescribedDisplacement(const BoundaryCondition<dim> &boundary)
      : Function<dim>(dim), boundary(boundary)
  {
  }

  void vector_value(const Point<dim> &x, Vector<double> &values) const override
  {
    for (unsigned int c = 0; c < dim; ++c)
      values[c] = value(x, c);
  }

  double value(const Point<dim> &x, const unsigned int component) const override
  {
    const Expression<dim> &expression = boundary.displacement[component];
    return expression ? expression->value(x) : 0.;
  }

private:
  const BoundaryCondition<dim> &boundary;
};
} // namespace

template <int dim>
unsigned int held_axis(const typename Triangulation<dim>::cell_iterator &cell,
                       const unsigned int face)
{
  Point<dim - 1> middle;
  for (unsigned int s = 0; s < dim - 1; ++s)
    middle[s] = 0.5;
  const ContactAxes<dim> axes =
      contact_axes(map_of<dim>(cell).normal(face, point_on_face<dim>(face, middle)));
  AssertThrow(!axes.is_rotated(), ExcMessage("No axis is normal to a face with u_n = 0."));
  return axes.axis;
}

namespace
{
/** u_n = 0 at all nodes of faces, one of which may have another axis than the next. */
template <int dim>
void hold_normals(const Scene<dim> &scene, const DoFHandler<dim> &dof_handler,
                  const IndexSet &relevant, AffineConstraints<double> &constraints)
{
  const FiniteElement<dim> &fe = dof_handler.get_fe();
  std::vector<types::global_dof_index> dofs(fe.dofs_per_cell);
  for (const auto &cell : dof_handler.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
    {
      if (cell->is_artificial() || !cell->at_boundary(face) ||
          !scene.boundaries[cell->face(face)->boundary_id()].holds_normal())
        continue;
      const unsigned int axis = held_axis<dim>(cell, face);
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (fe.system_to_component_index(i).first == axis && fe.has_support_on_face(i, face) &&
            relevant.is_element(dofs[i]) && !constraints.is_constrained(dofs[i]))
          constraints.add_line(dofs[i]);
    }
}
} // namespace

template <int dim>
void constrain_supports(const Scene<dim> &scene, const DoFHandler<dim> &dof_handler,
                        const IndexSet &relevant, AffineConstraints<double> &constraints)
{
  constraints.reinit(relevant);
  DoFTools::make_hanging_node_constraints(dof_handler, constraints);
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    ComponentMask mask(dim, false);
    for (unsigned int c = 0; c < dim; ++c)
      mask.set(c, boundary.displacement[c] != nullptr);
    if (mask.n_selected_components() > 0)
      VectorTools::interpolate_boundary_values(
          dof_handler, boundary.id, PrescribedDisplacement<dim>(boundary), constraints, mask);
  }
  hold_normals(scene, dof_handler, relevant, constraints);
}

template void constrain_supports(const Scene<2> &, const DoFHandler<2> &, const IndexSet &,
                                 AffineConstraints<double> &);
template void constrain_supports(const Scene<3> &, const DoFHandler<3> &, const IndexSet &,
                                 AffineConstraints<double> &);
template unsigned int held_axis<2>(const Triangulation<2>::cell_iterator &, unsigned int);
template unsigned int held_axis<3>(const Triangulation<3>::cell_iterator &, unsigned int);
} // namespace hpvi
