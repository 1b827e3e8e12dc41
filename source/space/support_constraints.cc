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

/** What holds a face. */
template <int dim>
struct Support
{
  const BoundaryCondition<dim> *boundary;
  Tensor<1, dim> normal;
};

bool is_on_line(const Point<3> &x, const unsigned int line)
{
  const Point<3> a = GeometryInfo<3>::unit_cell_vertex(
                     GeometryInfo<3>::line_to_cell_vertices(line, 0)),
                 b = GeometryInfo<3>::unit_cell_vertex(
                     GeometryInfo<3>::line_to_cell_vertices(line, 1));
  return std::abs(a.distance(x) + x.distance(b) - 1) < 1e-12;
}
} // namespace

template <int dim>
std::vector<SupportedNode<dim>> supported_nodes(const Scene<dim> &scene,
                                                const DoFHandler<dim> &dof_handler,
                                                const DegreeTables<dim> &tables)
{
  std::map<types::global_dof_index, SupportedNode<dim>> nodes;
  std::map<unsigned int, std::vector<Support<dim>>> of_edge;
  std::vector<types::global_dof_index> dofs;
  const auto add = [&](const BoxTables<dim> &tables, const unsigned int shape,
                       const CellMap<dim> &map, const Support<dim> &support)
  {
    const auto &numbers = tables.numbers[shape];
    SupportedNode<dim> &node = nodes[dofs[numbers[0]]];
    for (unsigned int c = 0; c < dim; ++c)
      node.dofs[c] = dofs[numbers[c]];
    node.x = map.point(tables.fe.unit_support_point(numbers[0]));
    for (const PointCondition<dim> &condition :
         conditions_at(*support.boundary, support.normal, support.boundary->holds_normal(), node.x))
      node.add(condition);
    if (support.boundary->plate)
      node.add_plate(support.boundary->id);
  };
  for (const auto &cell : dof_handler.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
    {
      if (cell->is_artificial() || !cell->at_boundary(face))
        continue;
      const BoundaryCondition<dim> &boundary = scene.boundaries[cell->face(face)->boundary_id()];
      if (!boundary.has_displacement() && !boundary.holds_normal() && !boundary.plate)
        continue;
      const CellMap<dim> map = map_of<dim>(cell);
      const Support<dim> support{&boundary, normal_of_face(map, face)};
      const BoxTables<dim> &own = tables.take_dofs(cell, dofs);
      for (unsigned int i = 0; i < own.n_shapes; ++i)
        if (own.fe.has_support_on_face(own.numbers[i][0], face))
          add(own, i, map, support);
      if constexpr (dim == 3)
        for (unsigned int l = 0; l < GeometryInfo<2>::lines_per_cell; ++l)
          of_edge[cell->face(face)->line_index(l)].push_back(support);
    }
  // Where a support ends on a side an edge may be that of a larger cell, whose own face is free.
  if constexpr (dim == 3)
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (unsigned int l = 0; l < GeometryInfo<3>::lines_per_cell; ++l)
        if (!cell->is_artificial() && cell->line(l)->has_children())
          for (unsigned int half = 0; half < 2; ++half)
            if (const auto found = of_edge.find(cell->line(l)->child_index(half));
                found != of_edge.end())
            {
              const BoxTables<dim> &own = tables.take_dofs(cell, dofs);
              for (unsigned int i = 0; i < own.n_shapes; ++i)
                if (is_on_line(own.fe.unit_support_point(own.numbers[i][0]), l))
                  for (const Support<dim> &support : found->second)
                    add(own, i, map_of<dim>(cell), support);
            }
  std::vector<SupportedNode<dim>> result;
  for (auto &node : nodes)
    result.push_back(std::move(node.second));
  return result;
}

template <int dim>
void constrain_supports(const Scene<dim> &scene, const DoFHandler<dim> &dof_handler,
                        const DegreeTables<dim> &tables, const IndexSet &relevant,
                        AffineConstraints<double> &constraints)
{
  constraints.reinit(relevant);
  DoFTools::make_hanging_node_constraints(dof_handler, constraints);
  std::vector<SupportedNode<dim>> nodes;
  for (SupportedNode<dim> &node : supported_nodes(scene, dof_handler, tables))
    // A hanging node depends on nodes of the same support.
    if (relevant.is_element(node.dofs[0]) && !constraints.is_constrained(node.dofs[0]))
      nodes.push_back(std::move(node));
  constrain_supports(nodes, constraints);
}

template std::vector<SupportedNode<2>> supported_nodes(const Scene<2> &, const DoFHandler<2> &,
                                                       const DegreeTables<2> &);
template std::vector<SupportedNode<3>> supported_nodes(const Scene<3> &, const DoFHandler<3> &,
                                                       const DegreeTables<3> &);
template void constrain_supports(const Scene<2> &, const DoFHandler<2> &, const DegreeTables<2> &,
                                 const IndexSet &, AffineConstraints<double> &);
template void constrain_supports(const Scene<3> &, const DoFHandler<3> &, const DegreeTables<3> &,
                                 const IndexSet &, AffineConstraints<double> &);
} // namespace hpvi
