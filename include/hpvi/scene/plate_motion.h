// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_plate_motion_h
#define hpvi_plate_motion_h

#include <hpvi/scene/scene.h>

#include <optional>
#include <vector>

namespace hpvi
{
/** How the rigid plate on a boundary may move, point by point: `u = sum_m q_m R_m(x)`, the amounts q as RigidPlate has them. */
class PlateMotion
{
public:
  static constexpr unsigned int n_motions = RigidPlate<2>::n_motions;

  /** The boundary has a plate. */
  PlateMotion(const Scene<2> &scene, const BoundaryCondition<2> &boundary);

  const dealii::Point<2> &centre() const; ///< c, the mean point of the boundary
  double reach() const;                   ///< the largest distance of an end from it

  /** R_m: a unit translation, or `e_z x (x - c)` [length]. */
  dealii::Tensor<1, 2> motion(unsigned int m, const dealii::Point<2> &x) const;

  std::vector<unsigned int> free_motions() const;

  /** u there without the free motions. */
  dealii::Tensor<1, 2> prescribed(const dealii::Point<2> &x) const;

  /** `direction . u` at @p x, where no free motion changes it. */
  std::optional<double> held(const dealii::Tensor<1, 2> &direction,
                             const dealii::Point<2> &x) const;

  /** Of u at both @p ends, where it is that of the plate: the amounts q. */
  std::array<double, n_motions> amounts(const std::array<dealii::Point<2>, 2> &ends,
                                        const std::array<dealii::Tensor<1, 2>, 2> &u) const;

private:
  const RigidPlate<2> plate;
  dealii::Point<2> mean;
  double radius = 0;
};
} // namespace hpvi

#endif
