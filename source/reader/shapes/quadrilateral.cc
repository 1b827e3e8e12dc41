// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/shapes/quadrilateral.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
void read_corners(const Parameters &parameters, Geometry<2> &geometry)
{
  const std::vector<Point<2>> around = parameters.points<2>("Geometry", "Corners");
  if (around.size() != 4)
    parameters.reject("Geometry", "Corners",
                      "does not give four corners; a quadrilateral needs \"x, y; x, y; x, y; "
                      "x, y\", counterclockwise from the bottom left");
  geometry.corners = quadrilateral_corners({{around[0], around[1], around[2], around[3]}});
}

/** Of length 1, without squares, which over- and underflow. */
Tensor<1, 2> direction(const Tensor<1, 2> &edge)
{
  return edge / std::hypot(edge[0], edge[1]);
}

/** Each corner must turn left. */
std::optional<ShapeFlaw> flaw_of_quadrilateral(const Corners<2> &corners)
{
  const std::array<Point<2>, 4> around = {{corners[0], corners[1], corners[3], corners[2]}};
  for (unsigned int c = 0; c < 4; ++c)
  {
    const Tensor<1, 2> in = direction(around[c] - around[(c + 3) % 4]),
                       out = direction(around[(c + 1) % 4] - around[c]);
    if (!(in[0] * out[1] - in[1] * out[0] > 1e-12)) // no more than round-off
      return ShapeFlaw{"Corners",
                       "is degenerate, clockwise or not convex at " + to_string(around[c]) +
                           "; give the corners of a convex quadrilateral counterclockwise from "
                           "the bottom left",
                       ""};
  }
  return std::nullopt;
}
} // namespace

ShapeKind<2> quadrilateral_shape()
{
  const Patterns::List point(Patterns::Double(), 2, 2, ",");
  return {
      Shape::quadrilateral,
      "quadrilateral",
      "quadrilateral: convex, given by Corners.",
      {{"Geometry", "Corners", "", std::make_shared<Patterns::List>(point, 0, 4, ";"),
        "four points \"x, y; x, y; x, y; x, y\", or nothing",
        "Corners of the quadrilateral, counterclockwise from the bottom left: the edges between "
        "them are bottom, right, top, left."}},
      "Corners",
      read_corners,
      flaw_of_quadrilateral};
}
} // namespace hpvi
