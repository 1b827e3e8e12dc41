// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_node_freedom_h
#define hpvi_node_freedom_h

#include <hpvi/plane/solution.h>
#include <hpvi/plane/unknowns.h>

#include <array>
#include <map>
#include <set>
#include <vector>

namespace hpvi
{
/** How single nodes of a boundary may move while all others stay. Which of their unknowns are free depends on the frame, this does not. */
class NodeFreedom
{
public:
  using Node = std::array<dealii::types::global_dof_index, 2>; ///< by component

  /** @p unknowns must outlive this object. */
  NodeFreedom(const Solution<2> &solution, const Unknowns<2> &unknowns);

  /** Is it a part of a rigid plate, which would move with it? */
  bool is_on_plate(const Node &node) const;

  /** The unknowns of each plate's motion: which components of which nodes they are depends on the frame. */
  const std::vector<std::set<unsigned int>> &plates() const;

  /** Where supports leave it one direction, along an axis or along a slanted side with `u_n = 0`, that one; else zero. */
  dealii::Tensor<1, 2> only_direction(const Node &node) const;

  /** Is its displacement along @p direction prescribed, or all but that? */
  bool is_held(const Node &node, const dealii::Tensor<1, 2> &direction) const;

  /** What it takes to move a vertex against the springs on its edges, beside the stiffness of its cells [stress]. */
  double stiffness_of_springs(const Node &node) const;

private:
  const Unknowns<2> &unknowns;
  std::map<dealii::types::global_dof_index, double> springs; ///< of vertices, by first component
  std::set<dealii::types::global_dof_index> on_plates;       ///< first components
  std::vector<std::set<unsigned int>> of_plates;
};
} // namespace hpvi

#endif
