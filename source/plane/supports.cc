// SPDX-License-Identifier: LGPL-2.1-or-later

// A support prescribes a displacement, or a component of it; bilateral contact prescribes $u_n =
// 0$. At most nodes that is one condition or two. At corners, conditions from two edges meet: two
// normals that are not at right angles, a clamped edge next to a sliding one, or the same condition
// twice. Applying them one after the other would overwrite some and over-constrain others. So all
// conditions of a node are collected first, and solved together.
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/supports.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace hpvi
{
using namespace dealii;

// @sect3{Conditions of a node}
//
// Each condition is $d \cdot u = h$ with a unit direction $d$. Conditions that depend on others are
// dropped by Gram and Schmidt's process; whether they agree with them has been checked when the
// scene was read.
namespace
{
/** Orthonormal conditions with the same solutions, by Gram and Schmidt. */
template <int dim>
std::vector<PointCondition<dim>> independent(const std::vector<PointCondition<dim>> &conditions)
{
  std::vector<PointCondition<dim>> basis;
  for (PointCondition<dim> rest : conditions)
  {
    for (const PointCondition<dim> &q : basis)
    {
      const double product = rest.direction * q.direction;
      rest.direction -= product * q.direction;
      rest.value -= product * q.value;
    }
    const double norm = rest.direction.norm();
    if (norm > repeated_direction)
      basis.push_back({rest.direction / norm, rest.value / norm, rest.boundary});
  }
  return basis;
}
} // namespace

template <int dim>
void SupportedNode<dim>::add(const PointCondition<dim> &condition)
{
  if (std::none_of(conditions.begin(), conditions.end(),
                   [&](const PointCondition<dim> &known)
                   {
                     return known.boundary == condition.boundary &&
                            (known.direction - condition.direction).norm() < repeated_direction;
                   }))
    conditions.push_back(condition);
}

template <int dim>
void SupportedNode<dim>::add_plate(const types::boundary_id boundary)
{
  for (unsigned int c = 0; c < dim; ++c)
  {
    Tensor<1, dim> direction;
    direction[c] = 1.;
    add({direction, 0., boundary});
  }
  is_on_plate = true;
}

template <int dim>
bool SupportedNode<dim>::is_on(const types::boundary_id boundary) const
{
  return std::any_of(conditions.begin(), conditions.end(),
                     [&](const PointCondition<dim> &condition)
                     { return condition.boundary == boundary; });
}

// @sect3{Collecting them}
//
// Along boundary edges with a support, node by node. A node gets the conditions of a boundary once,
// whichever of its cells comes first; at a corner of the body it gets those of both edges.
template <int dim>
std::vector<SupportedNode<dim>> supported_nodes(const Scene<dim> &scene,
                                                const DofNumbering<dim> &numbering,
                                                const ShapeTables<dim> &tables)
{
  static_assert(dim == 2, "nodes along a straight edge");
  std::map<types::global_dof_index, SupportedNode<dim>> nodes;
  for (const auto &cell : numbering.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned() && cell->at_boundary())
      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->at_boundary(f))
          continue;
        const auto face = cell->face(f);
        const BoundaryCondition<dim> &boundary = scene.boundaries[face->boundary_id()];
        if (!boundary.has_displacement() && !boundary.holds_normal() && !boundary.plate)
          continue;
        const CellMap<dim> map = map_of<dim>(cell);
        const unsigned int p = numbering.degrees()[cell->active_cell_index()];
        const auto dofs = numbering.cell_dofs(cell->active_cell_index());
        const std::vector<unsigned int> &on_edge = tables.numbering(p).edge[f];
        const QGaussLobatto<1> &nodes_on_edge = tables.gauss_lobatto(p + 1);
        for (unsigned int k = 0; k <= p; ++k)
        {
          SupportedNode<dim> &node = nodes[dofs[on_edge[k]]];
          for (unsigned int c = 0; c < dim; ++c)
            node.dofs[c] = dofs[on_edge[c * (p + 1) + k]];
          const Point<dim> reference = point_on_face<dim>(f, nodes_on_edge.point(k));
          node.x = map.point(reference);
          for (const PointCondition<dim> &condition : conditions_at(
                   boundary, map.curve_normal(f, reference), boundary.holds_normal(), node.x))
            node.add(condition);
          if (boundary.plate)
            node.add_plate(boundary.id);
        }
      }
  std::vector<SupportedNode<dim>> result;
  for (auto &node : nodes)
    result.push_back(std::move(node.second));
  return result;
}

// @sect3{From conditions to constraints}
//
// <code>AffineConstraints</code> wants each constrained component expressed by free ones. Gauss and
// Jordan's elimination, with the largest component as pivot, does so for a direction askew as well
// as for an axis. A rigid plate, whose nodes follow each other, has constraints of its own, which agree with what
// other boundaries ask at its ends.
template <int dim>
void constrain_supports(const std::vector<SupportedNode<dim>> &nodes,
                        AffineConstraints<double> &constraints)
{
  for (const SupportedNode<dim> &node : nodes)
  {
    if (node.is_on_plate)
      continue;
    std::vector<PointCondition<dim>> rows = independent(node.conditions);
    std::vector<unsigned int> pivots;
    // Gauss and Jordan: each row is solved for its largest component, which leaves the others.
    for (PointCondition<dim> &row : rows)
    {
      unsigned int pivot = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(row.direction[d]) > std::abs(row.direction[pivot]))
          pivot = d;
      row.value /= row.direction[pivot];
      row.direction /= row.direction[pivot];
      for (PointCondition<dim> &other : rows)
        if (&other != &row)
        {
          const double factor = other.direction[pivot];
          other.value -= factor * row.value;
          other.direction -= factor * row.direction;
          other.direction[pivot] = 0.;
        }
      pivots.push_back(pivot);
    }
    for (unsigned int k = 0; k < rows.size(); ++k)
    {
      const types::global_dof_index dof = node.dofs[pivots[k]];
      constraints.add_line(dof);
      constraints.set_inhomogeneity(dof, rows[k].value);
      for (unsigned int d = 0; d < dim; ++d)
        if (d != pivots[k] &&
            std::abs(rows[k].direction[d]) > std::numeric_limits<double>::epsilon())
          constraints.add_entry(dof, node.dofs[d], -rows[k].direction[d]);
    }
  }
}

// @sect3{Which support carries what}
//
// In equilibrium the reaction of a node is a sum of forces along its conditions. Where there are
// more conditions than dimensions, that of least norm is taken: each boundary gets its share, and
// shares add up to the reaction.
/** With the orthonormal basis Q of the directions d_k: `mu = C' (C C')^{-1} Q force`, C_jk = q_j . d_k. */
template <int dim>
std::vector<double> SupportedNode<dim>::split(const Tensor<1, dim> &force) const
{
  const std::vector<PointCondition<dim>> basis = independent(conditions);
  FullMatrix<double> C(basis.size(), conditions.size()), CC(basis.size(), basis.size());
  Vector<double> components(basis.size()), weights(basis.size()), result(conditions.size());
  for (unsigned int j = 0; j < basis.size(); ++j)
  {
    components[j] = basis[j].direction * force;
    for (unsigned int k = 0; k < conditions.size(); ++k)
      C(j, k) = basis[j].direction * conditions[k].direction;
  }
  C.mTmult(CC, C);
  CC.gauss_jordan();
  CC.vmult(weights, components);
  C.Tvmult(result, weights);
  return {result.begin(), result.end()};
}

template struct SupportedNode<2>;
template struct SupportedNode<3>;
template std::vector<SupportedNode<2>> supported_nodes(const Scene<2> &, const DofNumbering<2> &,
                                                       const ShapeTables<2> &);
template void constrain_supports(const std::vector<SupportedNode<2>> &,
                                 AffineConstraints<double> &);
template void constrain_supports(const std::vector<SupportedNode<3>> &,
                                 AffineConstraints<double> &);
} // namespace hpvi
