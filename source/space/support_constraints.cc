// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/contact_axes.h>
#include <hpvi/space/support_constraints.h>

#include <deal.II/dofs/dof_tools.h>

#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Outwards on a plane face; one along an axis has no round-off of the others. */
template <int dim>
Tensor<1, dim> normal_of_face(const CellMap<dim> &map, const unsigned int face)
{
  Point<dim - 1> middle;
  for (unsigned int s = 0; s < dim - 1; ++s)
    middle[s] = 0.5;
  const ContactAxes<dim> axes = contact_axes(map.normal(face, point_on_face<dim>(face, middle)));
  if (axes.is_rotated())
    return axes.normal;
  Tensor<1, dim> result;
  result[axes.axis] = axes.normal[axes.axis] > 0 ? 1. : -1.;
  return result;
}
} // namespace

template <int dim>
std::vector<SupportedNode<dim>> supported_nodes(const Scene<dim> &scene,
                                                const DoFHandler<dim> &dof_handler,
                                                const BoxTables<dim> &tables)
{
  std::map<types::global_dof_index, SupportedNode<dim>> nodes;
  std::vector<types::global_dof_index> dofs(tables.fe.dofs_per_cell);
  for (const auto &cell : dof_handler.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
    {
      if (cell->is_artificial() || !cell->at_boundary(face))
        continue;
      const BoundaryCondition<dim> &boundary = scene.boundaries[cell->face(face)->boundary_id()];
      if (!boundary.has_displacement() && !boundary.holds_normal())
        continue;
      const CellMap<dim> map = map_of<dim>(cell);
      const Tensor<1, dim> normal = normal_of_face(map, face);
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < tables.n_shapes; ++i)
      {
        const auto &numbers = tables.numbers[i];
        if (!tables.fe.has_support_on_face(numbers[0], face))
          continue;
        SupportedNode<dim> &node = nodes[dofs[numbers[0]]];
        for (unsigned int c = 0; c < dim; ++c)
          node.dofs[c] = dofs[numbers[c]];
        node.x = map.point(tables.fe.unit_support_point(numbers[0]));
        for (const PointCondition<dim> &condition :
             conditions_at(boundary, normal, boundary.holds_normal(), node.x))
          node.add(condition);
      }
    }
  std::vector<SupportedNode<dim>> result;
  for (auto &node : nodes)
    result.push_back(std::move(node.second));
  return result;
}

template <int dim>
void constrain_supports(const Scene<dim> &scene, const DoFHandler<dim> &dof_handler,
                        const BoxTables<dim> &tables, const IndexSet &relevant,
                        AffineConstraints<double> &constraints)
{
  constraints.reinit(relevant);
  DoFTools::make_hanging_node_constraints(dof_handler, constraints);
  std::vector<SupportedNode<dim>> nodes;
  for (SupportedNode<dim> &node : supported_nodes(scene, dof_handler, tables))
    // A hanging node depends on nodes of the same plane, which move along it.
    if (relevant.is_element(node.dofs[0]) && !constraints.is_constrained(node.dofs[0]))
      nodes.push_back(std::move(node));
  constrain_supports(nodes, constraints);
}

template std::vector<SupportedNode<2>> supported_nodes(const Scene<2> &, const DoFHandler<2> &,
                                                       const BoxTables<2> &);
template std::vector<SupportedNode<3>> supported_nodes(const Scene<3> &, const DoFHandler<3> &,
                                                       const BoxTables<3> &);
template void constrain_supports(const Scene<2> &, const DoFHandler<2> &, const BoxTables<2> &,
                                 const IndexSet &, AffineConstraints<double> &);
template void constrain_supports(const Scene<3> &, const DoFHandler<3> &, const BoxTables<3> &,
                                 const IndexSet &, AffineConstraints<double> &);
} // namespace hpvi
