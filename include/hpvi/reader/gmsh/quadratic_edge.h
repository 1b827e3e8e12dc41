// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_quadratic_edge_h
#define hpvi_quadratic_edge_h

#include <hpvi/scene/curve.h>

namespace hpvi
{
/** `(1-t)(1-2t) a + 4t(1-t) m + t(2t-1) b` for t in [0,1]: an edge of second order through its middle node. */
class QuadraticEdge : public Curve
{
public:
  QuadraticEdge(const dealii::Point<2> &a, const dealii::Point<2> &m, const dealii::Point<2> &b);

  dealii::Point<2> point(double t) const override;
  dealii::Tensor<1, 2> derivative(double t) const override;
  double nearest(const dealii::Point<2> &x, double from, double to) const override;

  /** Does it run forward everywhere? So it does where the middle projects into the middle half of the chord. */
  bool is_regular() const;

  /** How far the middle is from the chord, over the length of the chord. */
  double bow() const;

private:
  double slope(const dealii::Point<2> &x, double t) const; ///< half of that of the squared distance

  const dealii::Point<2> start;
  const dealii::Tensor<1, 2> chord, bulge; ///< start + t chord + 4t(1-t) bulge
};
} // namespace hpvi

#endif
