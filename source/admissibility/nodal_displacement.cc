// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/admissibility/nodal_displacement.h>

#include <array>
#include <cmath>

namespace hpvi
{
using namespace dealii;

template <int dim>
typename NodalDisplacement<dim>::Node
NodalDisplacement<dim>::node(const std::vector<types::global_dof_index> &face_dofs,
                             const unsigned int j) const
{
  Node result;
  for (unsigned int c = 0; c < dim; ++c)
    result[c] = face_dofs[c * (face_dofs.size() / dim) + j];
  return result;
}

template <int dim>
double NodalDisplacement<dim>::along(const Tensor<1, dim> &direction, const Node &node) const
{
  double result = 0;
  for (unsigned int c = 0; c < dim; ++c)
    result += direction[c] * u[node[c]];
  return result;
}

template <int dim>
bool NodalDisplacement<dim>::may_move(const Node &node, const Tensor<1, dim> &direction) const
{
  if (freedom.is_held(node, direction))
    return false;
  const auto place = heeded.find(node[0]);
  if (place == heeded.end())
    return true;
  const auto &[other, is_all] = place->second;
  return !is_all && (direction - (direction * other) * other).norm() >= 1e-6;
}

/** Adds @p missing along @p direction, as supports allow, without a change along one that has been heeded. */
template <int dim>
void NodalDisplacement<dim>::move(const Node &node, const Tensor<1, dim> &direction,
                                  const double missing)
{
  const auto place = heeded.find(node[0]);
  const bool is_new = place == heeded.end();
  if (freedom.is_on_plate(node) || (!is_new && place->second.is_all))
    return;
  const Tensor<1, dim> only = freedom.only_direction(node);
  const bool has_one = only.norm_square() > 0.;
  Tensor<1, dim> step = direction;
  if (has_one)
    step = (direction * only) * only;
  else if (!is_new)
    step -= (direction * place->second.direction) * place->second.direction;
  if (step.norm() < 1e-6) // the face before this one has set it, or it cannot move
    return;
  heeded[node[0]] = {direction, has_one || !is_new};
  for (unsigned int c = 0; c < dim; ++c)
    if (unknowns.terms(node[c]).size() > 0)
      u[node[c]] += missing / (direction * step) * step[c];
}

// Where two bodies touch, the nodes inside the edge are those of the slave: what it shares with the other body the least energy
// decides. A vertex of the softer body moves, or that of the other where supports hold it, or another pair has moved it.
template <int dim>
void NodalDisplacement<dim>::move_opposite(const ContactFace<dim> &face, const FaceDofs<dim> &dofs,
                                           const Tensor<1, dim> &direction,
                                           const std::function<double(double)> &wanted)
{
  const unsigned int last = face.degree;
  const auto stiffness = [&](const auto &cell)
  { return solution.scene.material_of(cell).weight(); };
  const bool is_softer = stiffness(face.segments[0].cell) < stiffness(face.cell);
  std::array<double, 2> moved{};
  for (unsigned int end = 0; end < 2; ++end)
  {
    const Node own = node(dofs.own, end * last), other = node(dofs.opposite, end * last);
    if (may_move(other, direction) && (is_softer || !may_move(own, direction)))
      moved[end] = along(direction, own) - along(direction, other) - wanted(end);
  }
  if (moved[0] == 0. && moved[1] == 0.)
    return;
  for (unsigned int j = 0; j <= last; ++j)
  {
    const double s = solution.tables.gauss_lobatto(last + 1).point(j)[0];
    if ((j > 0 || moved[0] != 0.) && (j < last || moved[1] != 0.))
      move(node(dofs.opposite, j), direction, (1. - s) * moved[0] + s * moved[1]);
  }
}

template <int dim>
void NodalDisplacement<dim>::set(const ContactFace<dim> &face, const Tensor<1, dim> &direction,
                                 const std::function<double(double)> &wanted)
{
  const FaceDofs<dim> dofs(face, solution.displacement_space, solution.tables);
  if (!dofs.opposite.empty())
    move_opposite(face, dofs, direction, wanted);
  for (unsigned int j = 0; j <= face.degree; ++j)
  {
    const Node own = node(dofs.own, j);
    double missing =
        wanted(solution.tables.gauss_lobatto(face.degree + 1).point(j)[0]) - along(direction, own);
    if (!dofs.opposite.empty())
      missing += along(direction, node(dofs.opposite, j));
    move(own, direction, missing);
  }
}

template class NodalDisplacement<2>;
} // namespace hpvi
