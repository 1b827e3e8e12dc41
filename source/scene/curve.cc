// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/curve.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

Circle::Circle(const Point<2> &centre, const double radius) : centre(centre), radius(radius)
{
}

namespace
{
/** cos and sin, which vanish at multiples of 90 degrees: there a side may lie on an axis. */
Tensor<1, 2> direction(const double t)
{
  Tensor<1, 2> result({std::cos(t), std::sin(t)});
  for (unsigned int d = 0; d < 2; ++d)
    if (std::abs(result[d]) < 1e-15)
      result[d] = 0;
  return result;
}
} // namespace

Point<2> Circle::point(const double t) const
{
  return centre + radius * direction(t);
}

Tensor<1, 2> Circle::derivative(const double t) const
{
  return radius * Tensor<1, 2>({-std::sin(t), std::cos(t)});
}

/** The angle that differs least from the middle of the interval, moved into it. */
double Circle::nearest(const Point<2> &x, const double from, const double to) const
{
  const double middle = (from + to) / 2,
               turns = std::remainder(std::atan2(x[1] - centre[1], x[0] - centre[0]) - middle,
                                      2 * numbers::PI);
  return std::clamp(middle + turns, std::min(from, to), std::max(from, to));
}

Point<2> CurvePiece::point(const double s) const
{
  return curve->point(from + s * (to - from));
}

Tensor<1, 2> CurvePiece::derivative(const double s) const
{
  return (to - from) * curve->derivative(from + s * (to - from));
}

double CurvePiece::nearest(const Point<2> &x) const
{
  return (curve->nearest(x, from, to) - from) / (to - from);
}

CurvePiece CurvePiece::between(const double s, const double t) const
{
  return {curve, from + s * (to - from), from + t * (to - from)};
}
} // namespace hpvi
