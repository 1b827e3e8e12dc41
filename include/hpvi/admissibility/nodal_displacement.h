// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_nodal_displacement_h
#define hpvi_nodal_displacement_h

#include <hpvi/admissibility/node_freedom.h>
#include <hpvi/contact/matching.h>

#include <array>
#include <functional>
#include <map>
#include <vector>

namespace hpvi
{
/** A displacement that is put together node by node from its components along the sides of the body. */
template <int dim>
class NodalDisplacement
{
public:
  NodalDisplacement(const Solution<dim> &solution, const Unknowns<dim> &unknowns,
                    const NodeFreedom<dim> &freedom)
      : u(solution.u.size()), solution(solution), unknowns(unknowns), freedom(freedom)
  {
  }

  /** `direction u = wanted(s)` at the nodes of a face, u the jump where bodies match. Two sides that meet at a corner are both heeded. */
  void set(const ContactFace<dim> &face, const dealii::Tensor<1, dim> &direction,
           const std::function<double(double)> &wanted);

  /** From now on what has been set may be overruled. */
  void release()
  {
    heeded.clear();
  }

  dealii::Vector<double> u;

private:
  using Node = typename NodeFreedom<dim>::Node;

  Node node(const std::vector<dealii::types::global_dof_index> &face_dofs, unsigned int j) const;
  double along(const dealii::Tensor<1, dim> &direction, const Node &node) const;
  bool may_move(const Node &node, const dealii::Tensor<1, dim> &direction) const;
  void move(const Node &node, const dealii::Tensor<1, dim> &direction, double missing);
  void move_opposite(const ContactFace<dim> &face, const FaceDofs<dim> &dofs,
                     const dealii::Tensor<1, dim> &direction,
                     const std::function<double(double)> &wanted);

  const Solution<dim> &solution;
  const Unknowns<dim> &unknowns;
  const NodeFreedom<dim> &freedom;
  /** Of a node, by its first component. */
  struct Heeded
  {
    dealii::Tensor<1, dim> direction;
    bool is_all; ///< nothing is left of the node's freedom
  };
  std::map<dealii::types::global_dof_index, Heeded> heeded;
};
} // namespace hpvi

#endif
