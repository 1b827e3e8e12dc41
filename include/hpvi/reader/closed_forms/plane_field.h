// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_plane_field_h
#define hpvi_plane_field_h

#include <hpvi/scene/exact_solution.h>

#include <memory>
#include <vector>

namespace hpvi
{
/** A field of plane strain in space: `u = (u_x(x,y), u_y(x,y), 0)` for each z. */
class PlaneField : public ExactSolution<3>
{
public:
  /** @p in_plane is that of plane strain. */
  explicit PlaneField(std::shared_ptr<const ExactSolution<2>> in_plane);

  dealii::Tensor<1, 3> displacement(const dealii::Point<3> &x) const override;
  dealii::Tensor<2, 3> gradient(const dealii::Point<3> &x) const override;
  double multiplier(const dealii::Point<3> &x) const override;
  double pressure(const dealii::Point<3> &x) const override;
  std::vector<dealii::Point<3>> singularities() const override;

private:
  const std::shared_ptr<const ExactSolution<2>> in_plane;
};
} // namespace hpvi

#endif
