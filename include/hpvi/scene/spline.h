// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_spline_h
#define hpvi_spline_h

#include <hpvi/scene/curve.h>

#include <vector>

namespace hpvi
{
/**
 * The cubic spline through points by the length of the chords between them: periodic where the last point is the first,
 * else not-a-knot, one cubic over the first two intervals and one over the last two. A natural end would cost two orders of
 * accuracy. Needs four points, closed three and the first again.
 */
class Spline : public Curve
{
public:
  explicit Spline(const std::vector<dealii::Point<2>> &points);

  const std::vector<double> &knots() const; ///< parameters of the points, from 0 [length]

  dealii::Point<2> point(double t) const override;
  dealii::Tensor<1, 2> derivative(double t) const override;
  double nearest(const dealii::Point<2> &x, double from, double to) const override;

  /**
   * How far a smooth curve through the points may be from this one between two parameters [length]: h^4/24 times the fourth derivative, as of a cubic
   * through four of them, by the largest jump of third derivatives at knots that are near, over h.
   */
  double doubt(double from, double to) const;

private:
  dealii::Tensor<1, 2> third_derivative(unsigned int interval) const;
  unsigned int interval(double t) const; ///< of the knots, periodic splines go on
  double into(double t) const;           ///< the range of the knots, of periodic ones
  dealii::Tensor<1, 2> second_derivative(double t) const;

  const std::vector<dealii::Point<2>> points;
  const bool is_periodic;
  std::vector<double> parameters;
  std::vector<dealii::Tensor<1, 2>> slopes; ///< at the points
};

/** That of a spline; any other curve is meant as it is. */
double doubt_of(const CurvePiece &piece);
} // namespace hpvi

#endif
