// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_plate_motion_h
#define hpvi_plate_motion_h

#include <hpvi/scene/scene.h>

#include <optional>
#include <vector>

namespace hpvi
{
/** How the rigid plate on a boundary may move, point by point: `u = sum_m q_m R_m(x)`, the amounts q as RigidPlate has them. */
template <int dim>
class PlateMotion
{
public:
  static constexpr unsigned int n_motions = RigidPlate<dim>::n_motions;

  /** The boundary has a plate. */
  PlateMotion(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary);

  const dealii::Point<dim> &centre() const; ///< c, the mean point of the boundary
  double reach() const;                     ///< the largest distance of a corner from it

  /** R_m: a unit translation, or `e x (x - c)` [length], e along an axis, in the plane z. */
  dealii::Tensor<1, dim> motion(unsigned int m, const dealii::Point<dim> &x) const;

  std::vector<unsigned int> free_motions() const;

  /** u there without the free motions. */
  dealii::Tensor<1, dim> prescribed(const dealii::Point<dim> &x) const;

  /** `direction . u` at @p x, where no free motion changes it. */
  std::optional<double> held(const dealii::Tensor<1, dim> &direction,
                             const dealii::Point<dim> &x) const;

private:
  const RigidPlate<dim> plate;
  dealii::Point<dim> mean;
  double radius = 0;
};
} // namespace hpvi

#endif
