// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/shapes/half_disc.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

CoarseMesh HalfDisc::mesh() const
{
  const double turn = angle * numbers::PI / 180, half = 0.5;
  const Tensor<1, 2> along(Circle(Point<2>(), 1).point(turn)), up({-along[1], along[0]});
  CoarseMesh result;
  const auto add = [&](const double x, const double y)
  { result.vertices.push_back(centre + radius * (x * along + y * up)); };
  for (const double y : {0., half}) // 0 to 5: the squares
    for (const double x : {-half, 0., half})
      add(x, y);
  const auto circle = std::make_shared<const Circle>(centre, radius);
  const auto eighth = [&](const unsigned int k) { return turn + k * numbers::PI / 4; };
  for (unsigned int k = 0; k <= 4; ++k) // 6 to 10: the arc
    result.vertices.push_back(circle->point(eighth(k)));
  result.cells = {{{{0, 1, 4, 3}}}, {{{1, 2, 5, 4}}}, {{{2, 6, 7, 5}}},
                  {{{4, 5, 7, 8}}}, {{{3, 4, 8, 9}}}, {{{10, 0, 3, 9}}}};
  result.boundaries = {"flat", "arc"};
  result.edges = {{{{10, 0}}, 0}, {{{0, 1}}, 0}, {{{1, 2}}, 0}, {{{2, 6}}, 0}};
  for (unsigned int k = 0; k < 4; ++k)
    result.edges.push_back({{{6 + k, 7 + k}}, 1, {circle, eighth(k), eighth(k + 1)}});
  return result;
}

namespace
{
void read_half_disc(const Parameters &parameters, Geometry<2> &geometry)
{
  const double radius = parameters.number("Geometry", "Radius");
  if (!(radius > 0))
    parameters.reject("Geometry", "Radius", "is no radius; give a positive number");
  geometry.mesh = std::make_shared<const CoarseMesh>(HalfDisc{
      parameters.points<2>("Geometry", "Centre")[0], radius, parameters.number("Geometry", "Angle")}
                                                         .mesh());
}
} // namespace

ShapeKind<2> half_disc_shape()
{
  return {Shape::half_disc,
          "half disc",
          "half disc: around Centre with Radius, above its flat side; its boundaries are flat and "
          "arc.",
          {centre_entry(),
           radius_entry(),
           {"Geometry", "Angle", "0", std::make_shared<Patterns::Double>(-1e6, 1e6),
            "a number of degrees",
            "Angle of the flat side of a half disc against the x axis, counterclockwise; the disc "
            "lies to the left of it: 180 is a disc that hangs below [degrees]."}},
          "Radius",
          read_half_disc,
          nullptr,
          [](const GeometryText &) {
            return SideNames{{"flat", "arc"}};
          },
          false};
}
} // namespace hpvi
