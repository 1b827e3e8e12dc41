// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/nodal_displacement.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
/** How much more it costs to move a node that is not to move first; what it moves all the same is a part of 1e-6. */
constexpr double reluctance = 1e6;

/** Of a move of 1: where supports leave less of it a node is held. */
constexpr double held = 1e-6;

/** Of the square of a move: less is left of one whose direction others have taken. */
constexpr double nothing_left = 1e-12;

/** What a move, or a displacement, does along a condition. */
template <class Condition, class Value>
double along(const Condition &condition, const Value &value)
{
  double result = 0;
  for (const auto &[node, sign] : condition.nodes)
    result += sign * (condition.direction * value(node));
  return result;
}
} // namespace

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

/** What is wished at a node of a face. */
template <int dim>
double NodalDisplacement<dim>::at(const Wish &wish, const unsigned int j) const
{
  return wish.value(solution.tables.gauss_lobatto(wish.face->degree + 1).point(j)[0]);
}

template <int dim>
void NodalDisplacement<dim>::wish(const ContactFace<dim> &face, const Tensor<1, dim> &direction,
                                  const std::function<double(double)> &value)
{
  wishes.push_back(
      {&face, FaceDofs<dim>(face, solution.displacement_space, solution.tables), direction, value});
}

/** Which of two nodes that are opposite to each other is not to move first. */
template <int dim>
void NodalDisplacement<dim>::find_reluctant(const Wish &wish, const unsigned int j)
{
  const Node own = node(wish.dofs.own, j), other = node(wish.dofs.opposite, j);
  const auto stiffness = [&](const auto &cell, const Node &of)
  { return solution.scene.material_of(cell).residual_weight() + freedom.stiffness_of_springs(of); };
  const bool is_softer =
      stiffness(wish.face->segments[0].cell, other) < stiffness(wish.face->cell, own);
  const bool other_moves = !freedom.is_held(other, wish.direction) &&
                           (is_softer || freedom.is_held(own, wish.direction));
  costs[other_moves ? own[0] : other[0]] = reluctance;
}

/** The move that costs least for what it does along a condition; none where supports hold the nodes. */
template <int dim>
typename NodalDisplacement<dim>::Move
NodalDisplacement<dim>::free_move(const Condition &condition) const
{
  Move result;
  for (const auto &[node, sign] : condition.nodes)
  {
    if (freedom.is_on_plate(node))
      continue;
    const auto cost = costs.find(node[0]);
    const Tensor<1, dim> only = freedom.only_direction(node);
    const Tensor<1, dim> step = only.norm_square() > 0. ? (condition.direction * only) * only
                                : freedom.is_held(node, condition.direction) ? Tensor<1, dim>()
                                                                             : condition.direction;
    if (step.norm() >= held)
      result[node[0]] = {node, sign * step / (cost == costs.end() ? 1. : cost->second)};
  }
  return result;
}

// Gram's and Schmidt's way.
template <int dim>
typename NodalDisplacement<dim>::Move NodalDisplacement<dim>::part_left(const Condition &condition,
                                                                        const Steps &steps) const
{
  Move move = free_move(condition);
  const double of_all = work(condition, move);
  std::set<unsigned int> earlier;
  for (const auto &[node, sign] : condition.nodes)
    if (const auto known = steps.of_node.find(node[0]); known != steps.of_node.end())
      earlier.insert(known->second.begin(), known->second.end());
  for (const unsigned int k : earlier)
  {
    const Step &step = steps.all[k];
    const double part = work(condition, step.move) / step.work;
    for (const auto &[dof, moved] : step.move)
      move.emplace(dof, std::pair{moved.first, Tensor<1, dim>()}).first->second.second -=
          part * moved.second;
  }
  return work(condition, move) > nothing_left * of_all ? move : Move();
}

template <int dim>
double NodalDisplacement<dim>::work(const Condition &condition, const Move &move)
{
  return along(condition,
               [&](const Node &node)
               {
                 const auto found = move.find(node[0]);
                 return found == move.end() ? Tensor<1, dim>() : found->second.second;
               });
}

template <int dim>
typename NodalDisplacement<dim>::Steps
NodalDisplacement<dim>::steps_to(const std::vector<Condition> &conditions) const
{
  Steps result;
  for (const Condition &condition : conditions)
  {
    const Move move = part_left(condition, result);
    for (const auto &[dof, moved] : move)
      result.of_node[dof].push_back(result.all.size());
    if (!move.empty())
      result.all.push_back({condition, move, work(condition, move)});
  }
  return result;
}

/** A second round takes away the round-off of the first. */
template <int dim>
void NodalDisplacement<dim>::meet(const std::vector<Condition> &conditions)
{
  const Steps steps = steps_to(conditions);
  for (unsigned int round = 0; round < 2; ++round)
    for (const auto &[condition, move, work] : steps.all)
    {
      const double is = along(condition,
                              [&](const Node &node)
                              {
                                Tensor<1, dim> value;
                                for (unsigned int c = 0; c < dim; ++c)
                                  value[c] = u[node[c]];
                                return value;
                              });
      for (const auto &[dof, moved] : move)
        for (unsigned int c = 0; c < dim; ++c)
          u[moved.first[c]] += (condition.value - is) / work * moved.second[c];
    }
}

// The nodes inside an edge are those of the slave: what it shares with the other body the least energy decides. Where vertices of the
// other move, its nodes between them do linearly.
template <int dim>
void NodalDisplacement<dim>::stretch(const Wish &wish, const Vector<double> &before)
{
  const unsigned int last = wish.face->degree;
  std::array<double, 2> moved{};
  for (unsigned int end = 0; end < 2; ++end)
    for (unsigned int c = 0; c < dim; ++c)
    {
      const types::global_dof_index dof = node(wish.dofs.opposite, end * last)[c];
      moved[end] += wish.direction[c] * (u[dof] - before[dof]);
    }
  if (moved[0] == 0. && moved[1] == 0.)
    return;
  std::vector<Condition> inside;
  for (unsigned int j = 1; j < last; ++j)
  {
    const double s = solution.tables.gauss_lobatto(last + 1).point(j)[0];
    const Node other = node(wish.dofs.opposite, j);
    double value = (1. - s) * moved[0] + s * moved[1];
    for (unsigned int c = 0; c < dim; ++c)
      value += wish.direction[c] * before[other[c]];
    inside.push_back({{{other, 1.}}, wish.direction, value});
  }
  meet(inside);
}

template <int dim>
typename NodalDisplacement<dim>::Condition
NodalDisplacement<dim>::condition_at(const Wish &wish, const unsigned int j) const
{
  Condition result{{{node(wish.dofs.own, j), 1.}}, wish.direction, at(wish, j)};
  if (!wish.dofs.opposite.empty())
    result.nodes.emplace_back(node(wish.dofs.opposite, j), -1.);
  return result;
}

/** Those at the ends of faces, in the order of wishes. */
template <int dim>
std::vector<typename NodalDisplacement<dim>::Condition>
NodalDisplacement<dim>::conditions_at_vertices()
{
  std::vector<Condition> result;
  costs.clear();
  for (const Wish &wish : wishes)
    for (const unsigned int j : {0U, wish.face->degree})
    {
      result.push_back(condition_at(wish, j));
      if (!wish.dofs.opposite.empty())
        find_reluctant(wish, j);
    }
  return result;
}

template <int dim>
std::vector<std::array<bool, 2>>
NodalDisplacement<dim>::held_ends(const std::vector<ContactFace<dim>> &faces)
{
  const Steps steps = steps_to(conditions_at_vertices());
  std::vector<std::array<bool, 2>> result;
  for (const ContactFace<dim> &face : faces)
  {
    const Tensor<1, dim> normal = face.frame(0.5).normal;
    const Wish open{&face, FaceDofs<dim>(face, solution.displacement_space, solution.tables),
                    normal, [](const double) { return 0.; }};
    std::array<bool, 2> &ends = result.emplace_back();
    for (unsigned int end = 0; end < 2; ++end)
    {
      const Condition condition = condition_at(open, end * face.degree);
      ends[end] =
          std::all_of(condition.nodes.begin(), condition.nodes.end(),
                      [&](const auto &one) { return freedom.is_held(one.first, normal); }) ||
          part_left(condition, steps).empty();
    }
  }
  return result;
}

template <int dim>
void NodalDisplacement<dim>::move()
{
  const std::vector<Condition> at_vertices = conditions_at_vertices();
  std::vector<Condition> inside;
  const Vector<double> before = u;
  meet(at_vertices);
  for (const Wish &wish : wishes)
    if (!wish.dofs.opposite.empty())
      stretch(wish, before);
  for (const Wish &wish : wishes)
    for (unsigned int j = 1; j < wish.face->degree; ++j)
    {
      Condition own{{{node(wish.dofs.own, j), 1.}}, wish.direction, at(wish, j)};
      if (!wish.dofs.opposite.empty())
        for (unsigned int c = 0; c < dim; ++c)
          own.value += wish.direction[c] * u[node(wish.dofs.opposite, j)[c]];
      inside.push_back(std::move(own));
    }
  meet(inside);
  wishes.clear();
}

template class NodalDisplacement<2>;
} // namespace hpvi
