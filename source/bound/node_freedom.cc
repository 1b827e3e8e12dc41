// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/node_freedom.h>
#include <hpvi/plane/springs.h>
#include <hpvi/plane/supports.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Adds a set to disjoint ones, and unites with it those that it meets. */
void unite(std::set<unsigned int> set, std::vector<std::set<unsigned int>> &sets)
{
  const auto meets = [&](const std::set<unsigned int> &other)
  {
    return std::any_of(other.begin(), other.end(),
                       [&](const unsigned int element) { return set.count(element) > 0; });
  };
  std::vector<std::set<unsigned int>> result;
  for (const std::set<unsigned int> &other : sets)
    if (meets(other))
      set.insert(other.begin(), other.end());
    else
      result.push_back(other);
  result.push_back(set);
  sets.swap(result);
}
} // namespace

NodeFreedom::NodeFreedom(const Solution<2> &solution, const Unknowns<2> &unknowns)
    : unknowns(unknowns)
{
  for (const SpringFace &face :
       spring_faces(solution.scene, solution.displacement_space, solution.tables))
  {
    const unsigned int n = face.dofs.size() / 2;
    double sum = 0; // of all entries: int k_n + k_t, for functions sum to 1
    for (unsigned int i = 0; i < face.dofs.size(); ++i)
      for (unsigned int j = 0; j < n; ++j)
        sum += face.matrix(i, i / n * n + j);
    for (const unsigned int end : {0U, n - 1})
      springs[face.dofs[end]] += sum / 6.; // a function that falls to zero along the edge
  }
  if (!solution.scene.has_plates())
    return;
  for (const SupportedNode<2> &node :
       supported_nodes(solution.scene, solution.displacement_space.numbering(), solution.tables))
    if (node.is_on_plate)
    {
      on_plates.insert(node.dofs[0]);
      std::set<unsigned int> motion;
      for (const types::global_dof_index dof : node.dofs)
        for (const auto &[unknown, weight] : unknowns.terms(dof))
          motion.insert(unknown);
      unite(motion, of_plates);
    }
}

bool NodeFreedom::is_on_plate(const Node &node) const
{
  return on_plates.count(node[0]) > 0;
}

double NodeFreedom::stiffness_of_springs(const Node &node) const
{
  const auto found = springs.find(node[0]);
  return found == springs.end() ? 0. : found->second;
}

const std::vector<std::set<unsigned int>> &NodeFreedom::plates() const
{
  return of_plates;
}

Tensor<1, 2> NodeFreedom::only_direction(const Node &node) const
{
  std::map<unsigned int, Tensor<1, 2>> directions; // of each unknown
  for (unsigned int c = 0; c < 2; ++c)
    for (const auto &[unknown, weight] : unknowns.terms(node[c]))
      directions[unknown][c] += weight;
  Tensor<1, 2> result;
  for (const auto &[unknown, direction] : directions)
    if (direction.norm() > result.norm())
      result = direction;
  for (const auto &[unknown, direction] : directions)
    if (std::abs(result[0] * direction[1] - result[1] * direction[0]) >
        1e-10 * result.norm_square())
      return {};
  return directions.empty() ? result : result / result.norm();
}

bool NodeFreedom::is_held(const Node &node, const Tensor<1, 2> &direction) const
{
  constexpr double sideways =
      0.05; // as far as it moves at most for what it is to move along the direction
  if (is_on_plate(node) ||
      (unknowns.terms(node[0]).size() == 0 && unknowns.terms(node[1]).size() == 0))
    return true;
  const Tensor<1, 2> only = only_direction(node);
  return only.norm_square() > 0. && std::abs(direction * only) < sideways;
}
} // namespace hpvi
