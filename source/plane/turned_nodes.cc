// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/turned_nodes.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

std::map<unsigned int, TurnedNode> turned_nodes(const ContactOperator<2> &contact_operator,
                                                const Unknowns<2> &unknowns)
{
  std::map<unsigned int, TurnedNode> result;
  for (const ContactOperator<2>::Rows &rows : contact_operator.rows())
  {
    const ContactFrame<2> frame = rows.face->frame(0.5);
    const Tensor<1, 2> &t = frame.tangent, &n = frame.normal;
    const bool along_x = std::abs(t[0]) >= std::abs(t[1]);
    const Tensor<1, 2> first = along_x ? t : n, second = along_x ? n : t;
    const unsigned int n_nodes = rows.dofs.size() / 2;
    for (unsigned int node = 0; node < n_nodes && std::abs(t[0] * t[1]) > 1e-12; ++node)
    {
      const std::array<types::global_dof_index, 2> dofs{
          {rows.dofs[node], rows.dofs[n_nodes + node]}};
      if (!unknowns.is_plain(dofs[0]) || !unknowns.is_plain(dofs[1]))
        continue;
      const std::array<unsigned int, 2> own{
          {unknowns.terms(dofs[0])[0].first, unknowns.terms(dofs[1])[0].first}};
      const TurnedNode turned{
          own, dofs, {{first[0] < 0 ? -first : first, second[1] < 0 ? -second : second}}};
      for (const unsigned int unknown : own)
        result.emplace(unknown, turned);
    }
  }
  return result;
}

std::vector<std::pair<unsigned int, double>> turned(const Terms &terms,
                                                    const std::map<unsigned int, TurnedNode> &nodes)
{
  std::map<unsigned int, double> sum;
  double largest = 0;
  for (const auto &[unknown, weight] : terms)
  {
    largest = std::max(largest, std::abs(weight));
    const auto found = nodes.find(unknown);
    if (found == nodes.end())
      sum[unknown] += weight;
    else
      for (unsigned int k = 0; k < 2; ++k)
        sum[found->second.unknowns[k]] +=
            weight * found->second.directions[k][unknown == found->second.unknowns[0] ? 0 : 1];
  }
  std::vector<std::pair<unsigned int, double>> result;
  for (const auto &[unknown, weight] : sum)
    if (std::abs(weight) > 1e-14 * largest) // the other direction of a slanted edge cancels
      result.emplace_back(unknown, weight);
  return result;
}
} // namespace hpvi
