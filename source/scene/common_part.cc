// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/common_part.h>

#include <deal.II/base/quadrature_lib.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Twice the area of a triangle, positive where it runs counterclockwise. */
double turn(const Point<2> &a, const Point<2> &b, const Point<2> &c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/** What lies to the left of the line from @p a to @p b. */
ConvexPolygon left_of(const Point<2> &a, const Point<2> &b, const ConvexPolygon &polygon)
{
  ConvexPolygon result;
  for (unsigned int k = 0; k < polygon.size(); ++k)
  {
    const Point<2> &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const double here = turn(a, b, from), there = turn(a, b, to);
    if (here >= 0)
      result.push_back(from);
    if ((here > 0 && there < 0) || (here < 0 && there > 0))
      result.push_back(from + here / (here - there) * (to - from));
  }
  return result;
}
} // namespace

double area_of(const ConvexPolygon &polygon)
{
  double sum = 0;
  for (unsigned int k = 2; k < polygon.size(); ++k)
    sum += turn(polygon[0], polygon[k - 1], polygon[k]);
  return sum / 2;
}

ConvexPolygon common_part(const ConvexPolygon &one, const ConvexPolygon &other)
{
  ConvexPolygon result = one;
  for (unsigned int k = 0; k < other.size() && !result.empty(); ++k)
    result = left_of(other[k], other[(k + 1) % other.size()], result);
  return result;
}

std::vector<WeightedPoint> rule_on(const ConvexPolygon &polygon, const unsigned int n)
{
  const QGauss<1> gauss(n);
  std::vector<WeightedPoint> result;
  for (unsigned int k = 2; k < polygon.size(); ++k)
  {
    const Point<2> &a = polygon[0], &b = polygon[k - 1], &c = polygon[k];
    const double measure = turn(a, b, c);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j) // a square, one side of which shrinks to the corner a
      {
        const double r = gauss.point(i)[0], s = gauss.point(j)[0];
        result.push_back({a + r * ((1 - s) * (b - a) + s * (c - a)),
                          gauss.weight(i) * gauss.weight(j) * r * measure});
      }
  }
  return result;
}
} // namespace hpvi
