// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/scene/contact_search.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A side that is one straight line. */
struct Line
{
  Tensor<1, 2> normal;
  double height, begin, end; ///< x . normal, and x . along between its ends
};

/** Nothing where it bends or has holes; @p along is the direction to measure in, or zero: that of the side. */
std::optional<Line> line_of(const Side<2> &side, Tensor<1, 2> &along, const double size)
{
  if (side.pieces.empty())
    return std::nullopt;
  const Tensor<1, 2> normal = side.normal(0, 0.5);
  if (along.norm() == 0)
    along = -cross_product_2d(normal);
  Line line{normal, normal * side.pieces[0][0], std::numeric_limits<double>::max(),
            std::numeric_limits<double>::lowest()};
  double length = 0;
  for (unsigned int k = 0; k < side.pieces.size(); ++k)
  {
    if ((!side.curves.empty() && side.curves[k]) ||
        (side.normal(k, 0.5) - normal).norm() > same_normal ||
        std::abs(normal * side.pieces[k][0] - line.height) > same_place * size)
      return std::nullopt;
    length += side.pieces[k][0].distance(side.pieces[k][1]);
    for (const Point<2> &corner : side.pieces[k])
    {
      line.begin = std::min(line.begin, along * corner);
      line.end = std::max(line.end, along * corner);
    }
  }
  if (line.end - line.begin > length + same_place * size) // it is in pieces
    return std::nullopt;
  return line;
}
} // namespace

double FacingPart::inside(const Point<2> &x) const
{
  return std::min(along * x - begin, end - along * x);
}

std::optional<FacingPart> contact_search(const Side<2> &first, const Side<2> &second,
                                         const double size, std::string &problem)
{
  Tensor<1, 2> along;
  const std::optional<Line> one = line_of(first, along, size), two = line_of(second, along, size);
  problem.clear();
  if (!one || !two)
    return std::nullopt;
  if ((one->normal - two->normal).norm() <= same_normal)
  {
    problem = "look the same way and do not face each other";
    return std::nullopt;
  }
  if ((one->normal + two->normal).norm() > same_normal)
    return std::nullopt;
  FacingPart result{along, std::max(one->begin, two->begin), std::min(one->end, two->end),
                    -two->height - one->height};
  if (std::abs(result.distance) <= same_place * size)
    result.distance = 0;
  if (result.end - result.begin <= same_place * size)
  {
    problem = "do not face each other: one ends before the other begins";
    return std::nullopt;
  }
  return result;
}
} // namespace hpvi
