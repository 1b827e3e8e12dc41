// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/scene/edge_path.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** cos 120 degrees: normals differ by 60 from those of parallel sides. */
constexpr double facing = -0.5;
constexpr unsigned int n_parts = 8; ///< of a curved edge, in which a line meets it once at most
} // namespace

Point<2> EdgePath::point(const double s) const
{
  if (curve && s > 0 && s < 1)
    return curve.point(s);
  return s < 1 ? ends[0] + s * (ends[1] - ends[0]) : ends[1];
}

Tensor<1, 2> EdgePath::derivative(const double s) const
{
  return curve ? curve.derivative(s) : ends[1] - ends[0];
}

Tensor<1, 2> EdgePath::normal(const double s) const
{
  const Tensor<1, 2> n = cross_product_2d(derivative(s));
  return n / n.norm();
}

double EdgePath::nearest(const Point<2> &x) const
{
  if (curve)
    return curve.nearest(x);
  const Tensor<1, 2> way = ends[1] - ends[0];
  return std::clamp((x - ends[0]) * way / way.norm_square(), 0., 1.);
}

EdgePath EdgePath::reversed() const
{
  return {{{ends[1], ends[0]}}, curve ? curve.between(1, 0) : CurvePiece()};
}

namespace
{
/** How far a point of a path is off a line. */
class Offset
{
public:
  Offset(const EdgePath &path, const Point<2> &x, const Tensor<1, 2> &n)
      : path(path), x(x), n(n), across(-cross_product_2d(n))
  {
  }

  double operator()(const double s) const
  {
    return (path.point(s) - x) * across;
  }

  double slope(const double s) const
  {
    return path.derivative(s) * across;
  }

  /** Between two places with values of different signs: Newton's method, bisection where it leaves them. */
  double root(double a, double b) const
  {
    const double at_a = (*this)(a);
    double s = (a + b) / 2;
    for (unsigned int step = 0; step < 80 && b - a > 0; ++step)
    {
      const double value = (*this)(s);
      if (value == 0)
        break;
      ((value > 0) == (at_a > 0) ? a : b) = s;
      const double next = s - value / slope(s);
      const double before = s;
      s = next > a && next < b ? next : (a + b) / 2;
      if (std::abs(s - before) < 1e-16)
        break;
    }
    return s;
  }

  /** Nothing where the path looks elsewhere. */
  std::optional<PlaceOpposite> place(const double s) const
  {
    if (path.normal(s) * n > facing)
      return std::nullopt;
    return PlaceOpposite{s, (path.point(s) - x) * n};
  }

private:
  const EdgePath &path;
  const Point<2> x;
  const Tensor<1, 2> n, across;
};

void take_nearer(const std::optional<PlaceOpposite> &one, std::optional<PlaceOpposite> &nearest)
{
  if (one && (!nearest || std::abs(one->distance) < std::abs(nearest->distance)))
    nearest = one;
}
} // namespace

std::optional<PlaceOpposite> place_opposite(const EdgePath &path, const Point<2> &x,
                                            const Tensor<1, 2> &n)
{
  const Offset offset(path, x, n);
  const double length = path.ends[0].distance(path.ends[1]);
  const unsigned int n_intervals = path.curve ? n_parts : 1;
  std::optional<PlaceOpposite> result;
  double before = offset(0);
  if (std::abs(before) <= same_on_edge * length)
    take_nearer(offset.place(0), result);
  for (unsigned int k = 1; k <= n_intervals; ++k)
  {
    const double begin = (k - 1.) / n_intervals, end = double(k) / n_intervals, value = offset(end);
    if (std::abs(value) <= same_on_edge * length)
      take_nearer(offset.place(end), result);
    if (before * value < 0)
      take_nearer(offset.place(path.curve ? offset.root(begin, end) : before / (before - value)),
                  result);
    before = value;
  }
  return result;
}

std::optional<PlaceOpposite> place_opposite(const EdgePath &path, const Point<2> &x,
                                            const Tensor<1, 2> &n, const double near)
{
  const Offset offset(path, x, n);
  const double length = path.ends[0].distance(path.ends[1]);
  double s = near;
  for (unsigned int step = 0; step < 8; ++step)
  {
    const double change = offset(s) / offset.slope(s);
    s -= change;
    if (!(s > -same_on_edge && s < 1 + same_on_edge))
      break;
    s = std::clamp(s, 0., 1.);
    if (std::abs(change) < 1e-10 && std::abs(offset(s)) <= 1e-13 * length)
      if (const auto place = offset.place(s))
        return place;
  }
  return place_opposite(path, x, n);
}
} // namespace hpvi
