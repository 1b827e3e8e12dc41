// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_plates_h
#define hpvi_plates_h

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>
#include <hpvi/plane/supports.h>
#include <hpvi/scene/plate_motion.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * Components of u at nodes of a rigid plate that determine its motions, as many as these are. With R(masters) the matrix
 * of the motions there, `u = sum_k q_k R_k + prescribed` has `q = R^{-1} (u(masters) - prescribed)`.
 */
template <int dim>
class PlateMasters
{
public:
  /** One component of u at a node. */
  struct Master
  {
    dealii::types::global_dof_index dof;
    dealii::Point<dim> x;
    unsigned int component;
  };

  /** Of @p motions by their numbers, at @p nodes; fewer where these do not determine all. */
  PlateMasters(const PlateMotion<dim> &plate, const std::vector<unsigned int> &motions,
               const std::vector<SupportedNode<dim>> &nodes);

  /** Of all of the free motions: what @p node has to do, but for what is constrained before. */
  void constrain(const PlateMotion<dim> &plate, const SupportedNode<dim> &node,
                 dealii::AffineConstraints<double> &constraints) const;

  /** How much of motion k a unit of master i is. */
  double share(const unsigned int k, const unsigned int i) const
  {
    return inverse(k, i);
  }

  std::vector<unsigned int> motions;
  std::vector<Master> masters;

private:
  dealii::FullMatrix<double> inverse;
};

/**
 * A rigid plate in the displacement space. As many unknowns at its two ends as it has free motions are its masters;
 * all other nodes on it follow them.
 */
class Plate
{
public:
  /** @p nodes: all that are supported, some of them by this plate. */
  Plate(const Scene<2> &scene, const BoundaryCondition<2> &boundary,
        const std::vector<SupportedNode<2>> &nodes);

  dealii::types::boundary_id boundary() const;
  const PlateMotion<2> &motion() const;

  void constrain(dealii::AffineConstraints<double> &constraints) const;

  /** `F . V + M phi` of test functions, by the motion of the ends. */
  void add_load(dealii::Vector<double> &load) const;

  /** U and phi of a displacement of the space. */
  std::array<double, PlateMotion<2>::n_motions>
  amounts(const dealii::Vector<double> &displacement) const;

private:
  const RigidPlate<2> plate;
  const dealii::types::boundary_id id;
  const PlateMotion<2> plate_motion;
  std::vector<SupportedNode<2>> nodes; ///< on this plate
  std::array<unsigned int, 2> ends;    ///< among them, as far from each other as any
};

/** All plates of a scene; none if it has none. */
std::vector<Plate> plates_of(const Scene<2> &scene, const std::vector<SupportedNode<2>> &nodes);
} // namespace hpvi

#endif
