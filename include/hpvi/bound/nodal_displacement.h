// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_nodal_displacement_h
#define hpvi_nodal_displacement_h

#include <hpvi/bound/node_freedom.h>
#include <hpvi/plane/matching.h>

#include <array>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * A displacement that is put together node by node from its components along the sides of bodies. All nodes that meet at one
 * place, of one body or of several, move together: each wish is met by the least move that leaves those before it met, in the sum of
 * squares over nodes. Of two bodies that touch the softer one moves, its springs included, or the other where supports hold
 * it: to move a stiffer node costs `reluctance` times as much.
 */
template <int dim>
class NodalDisplacement
{
public:
  NodalDisplacement(const Solution<dim> &solution, const NodeFreedom &freedom)
      : u(solution.u.size()), solution(solution), freedom(freedom)
  {
  }

  /** Of a displacement `direction u = value(s)` on a face, u the jump where bodies match. Wishes come in the order of their weight. */
  void wish(const ContactFace<dim> &face, const dealii::Tensor<1, dim> &direction,
            const std::function<double(double)> &value);

  /** Which ends of faces cannot move along their normals, for supports or what has been wished for hold them? */
  std::vector<std::array<bool, 2>> held_ends(const std::vector<ContactFace<dim>> &faces);

  /** Adds to u what has been wished for since the last time, as far as supports and wishes that come first allow. */
  void move();

  dealii::Vector<double> u;

private:
  using Node = NodeFreedom::Node;

  /** The nodes of a face, those opposite, and what is wished of them. */
  struct Wish
  {
    const ContactFace<dim> *face;
    FaceDofs<dim> dofs;
    dealii::Tensor<1, dim> direction;
    std::function<double(double)> value;
  };

  /** `direction (u of the first node - u of the second) = value`; one node: of that. */
  struct Condition
  {
    std::vector<std::pair<Node, double>> nodes; ///< with 1 and -1
    dealii::Tensor<1, dim> direction;
    double value;
  };

  /** By first component of nodes. */
  using Move = std::map<dealii::types::global_dof_index, std::pair<Node, dealii::Tensor<1, dim>>>;

  /** A move that changes what one condition asks for, and none of those before it. */
  struct Step
  {
    Condition condition;
    Move move;
    double work; ///< along the condition
  };
  struct Steps
  {
    std::vector<Step> all;
    std::map<dealii::types::global_dof_index, std::vector<unsigned int>> of_node;
  };

  Node node(const std::vector<dealii::types::global_dof_index> &face_dofs, unsigned int j) const;
  double at(const Wish &wish, unsigned int j) const;
  void find_reluctant(const Wish &wish, unsigned int j);
  void stretch(const Wish &wish, const dealii::Vector<double> &before);
  Condition condition_at(const Wish &wish, unsigned int j) const;
  std::vector<Condition> conditions_at_vertices();
  Move free_move(const Condition &condition) const;
  static double work(const Condition &condition, const Move &move);
  /** What moves before it leave of free_move(); none: nothing. */
  Move part_left(const Condition &condition, const Steps &steps) const;
  Steps steps_to(const std::vector<Condition> &conditions) const;
  void meet(const std::vector<Condition> &conditions);

  const Solution<dim> &solution;
  const NodeFreedom &freedom;
  std::vector<Wish> wishes;
  std::map<dealii::types::global_dof_index, double> costs; ///< of nodes that are not to move first
};
} // namespace hpvi

#endif
