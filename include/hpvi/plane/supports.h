// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_supports_h
#define hpvi_supports_h

#include <deal.II/lac/affine_constraints.h>
#include <hpvi/plane/dof_numbering.h>
#include <hpvi/scene/scene.h>

#include <array>
#include <vector>

namespace hpvi
{
/** A node of the displacement space on the boundary and all that supports and contact ask of it. */
template <int dim>
struct SupportedNode
{
  std::array<dealii::types::global_dof_index, dim> dofs; ///< one by component
  dealii::Point<dim> x;
  std::vector<PointCondition<dim>> conditions;
  bool is_on_plate =
      false; ///< conditions say where its force can point to, and PlateMasters what it does

  /** But for one that the same boundary has said already: a node inside a side gets it from each of its cells. */
  void add(const PointCondition<dim> &condition);

  /** A plate exerts any force, and holds what its motion leaves to hold. */
  void add_plate(dealii::types::boundary_id boundary);

  bool is_on(dealii::types::boundary_id boundary) const; ///< by a condition of it

  /**
   * The force at this node, taken apart by the conditions that can exert it: coefficients mu with
   * `force = sum_k mu_k direction_k`, of least norm where conditions repeat each other.
   */
  std::vector<double> split(const dealii::Tensor<1, dim> &force) const;
};

/**
 * The nodes on boundaries with prescribed displacements, bilateral contact or a rigid plate, by their first
 * unknown; a node in a corner stands once, with the conditions of all boundaries that meet there.
 */
template <int dim>
std::vector<SupportedNode<dim>> supported_nodes(const Scene<dim> &scene,
                                                const DofNumbering<dim> &numbering,
                                                const ShapeTables<dim> &tables);

/**
 * Prescribed displacements and `u_n = 0` as constraints. All conditions that meet at one node are
 * solved together, for as many components as they determine, those with the largest coefficients
 * first; conditions that repeat each other count once (the scene's check refuses contradictions).
 */
template <int dim>
void constrain_supports(const std::vector<SupportedNode<dim>> &nodes,
                        dealii::AffineConstraints<double> &constraints);
} // namespace hpvi

#endif
