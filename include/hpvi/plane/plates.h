// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_plates_h
#define hpvi_plates_h

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/vector.h>
#include <hpvi/plane/supports.h>
#include <hpvi/scene/plate_motion.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * A rigid plate in the displacement space. As many unknowns at its two ends as it has free motions are its masters;
 * all other nodes on it follow them, `u = sum_m q_m R_m(x)`, q from the masters.
 */
class Plate
{
public:
  /** @p nodes: all that are supported, some of them by this plate. */
  Plate(const Scene<2> &scene, const BoundaryCondition<2> &boundary,
        const std::vector<SupportedNode<2>> &nodes);

  dealii::types::boundary_id boundary() const;
  const PlateMotion &motion() const;

  void constrain(dealii::AffineConstraints<double> &constraints) const;

  /** `F . V + M phi` of test functions, by the motion of the ends. */
  void add_load(dealii::Vector<double> &load) const;

  /** U and phi of a displacement of the space. */
  std::array<double, PlateMotion::n_motions>
  amounts(const dealii::Vector<double> &displacement) const;

private:
  /** One component of u at an end that the free motions move. */
  struct Master
  {
    dealii::types::global_dof_index dof;
    dealii::Point<2> x;
    unsigned int component;
  };

  std::vector<Master> masters() const;

  const RigidPlate<2> plate;
  const dealii::types::boundary_id id;
  const PlateMotion plate_motion;
  std::vector<SupportedNode<2>> nodes; ///< on this plate
  std::array<unsigned int, 2> ends;    ///< among them, as far from each other as any
};

/** All plates of a scene; none if it has none. */
std::vector<Plate> plates_of(const Scene<2> &scene, const std::vector<SupportedNode<2>> &nodes);
} // namespace hpvi

#endif
