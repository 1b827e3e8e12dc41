// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_turned_nodes_h
#define hpvi_turned_nodes_h

#include <hpvi/plane/unknowns.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace hpvi
{
/** A node with two displacements that are unknowns, `u = sum_k x_k d_k` from now on. */
struct TurnedNode
{
  std::array<unsigned int, 2> unknowns; ///< of components 0 and 1
  std::array<dealii::types::global_dof_index, 2> dofs;
  std::array<dealii::Tensor<1, 2>, 2>
      directions; ///< tangent and normal, so that d_k has most of component k
};

/**
 * Nodes of slanted contact edges where both components of u are unknowns, by either of these. Tangent and normal in their
 * place make a scene that is turned the same.
 */
std::map<unsigned int, TurnedNode> turned_nodes(const ContactOperator<2> &contact_operator,
                                                const Unknowns<2> &unknowns);

/** A row of T by the unknowns of turned nodes. */
std::vector<std::pair<unsigned int, double>>
turned(const Terms &terms, const std::map<unsigned int, TurnedNode> &nodes);
} // namespace hpvi

#endif
