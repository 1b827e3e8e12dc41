// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/shapes/plate_with_hole.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
enum Boundary : unsigned int
{
  left,
  right,
  bottom,
  top,
  hole
};

/** Where a ray from the hole meets the outside of the plate, and which side begins there counterclockwise. */
struct Ray
{
  double angle; ///< at which it leaves the hole
  Point<2> end;
  unsigned int side;
};

/** Rays to the middles and corners of sides and between these, counterclockwise. */
std::vector<Ray> rays_of(const PlateWithHole &plate)
{
  const Point<2> &c = plate.centre, &a = plate.lower, &b = plate.upper;
  const std::array<std::pair<Point<2>, unsigned int>, 9> around{{{{b[0], c[1]}, right},
                                                                 {{b[0], b[1]}, top},
                                                                 {{c[0], b[1]}, top},
                                                                 {{a[0], b[1]}, left},
                                                                 {{a[0], c[1]}, left},
                                                                 {{a[0], a[1]}, bottom},
                                                                 {{c[0], a[1]}, bottom},
                                                                 {{b[0], a[1]}, right},
                                                                 {{b[0], c[1]}, right}}};
  unsigned int first = 0, last = 8;
  if (plate.is_quarter) // the quadrant that lies in the plate
  {
    first = c[0] == a[0] ? (c[1] == a[1] ? 0 : 6) : (c[1] == a[1] ? 2 : 4);
    last = first + 2;
  }
  std::vector<Ray> rays;
  for (unsigned int k = first; k < last; ++k)
    for (unsigned int i = 0; i < plate.angular || (i == plate.angular && k + 1 == last); ++i)
    {
      const double s = double(i) / plate.angular;
      rays.push_back({(k + s) * numbers::PI / 4,
                      around[k].first + s * (around[k + 1].first - around[k].first),
                      around[k].second});
    }
  return rays;
}
} // namespace

/** Layers grow as circles around the hole want them. */
CoarseMesh PlateWithHole::mesh() const
{
  const std::vector<Ray> rays = rays_of(*this);
  const auto circle = std::make_shared<const Circle>(centre, radius);
  CoarseMesh result;
  result.boundaries = {"left", "right", "bottom", "top", "hole"};
  const unsigned int n_rays = is_quarter ? rays.size() : rays.size() - 1;
  const auto vertex = [&](const unsigned int i, const unsigned int j)
  { return i * n_rays + j % n_rays; };
  const double far = std::max(upper[0] - lower[0], upper[1] - lower[1]) / (is_quarter ? 1 : 2),
               growth = std::pow(std::max(far / radius, 1.), 1. / radial);
  for (unsigned int i = 0; i <= radial; ++i)
    for (unsigned int j = 0; j < n_rays; ++j)
    {
      const double share = growth > 1 + 1e-6
                               ? (std::pow(growth, i) - 1) / (std::pow(growth, radial) - 1)
                               : double(i) / radial;
      const Point<2> begin = circle->point(rays[j].angle);
      result.vertices.push_back(i == radial ? rays[j].end : begin + share * (rays[j].end - begin));
    }
  for (unsigned int i = 0; i < radial; ++i)
    for (unsigned int j = 0; j + 1 < rays.size(); ++j)
      result.cells.push_back(
          {{{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}}});
  for (unsigned int j = 0; j + 1 < rays.size(); ++j)
    result.edges.push_back({{{vertex(radial, j), vertex(radial, j + 1)}}, rays[j].side});
  for (unsigned int j = rays.size() - 1; j-- > 0;)
    result.edges.push_back(
        {{{vertex(0, j + 1), vertex(0, j)}}, hole, {circle, rays[j + 1].angle, rays[j].angle}});
  if (is_quarter)
  {
    const auto side_at = [&](const Ray &ray)
    {
      if (std::abs(ray.end[1] - centre[1]) <= std::abs(ray.end[0] - centre[0]))
        return centre[1] == lower[1] ? bottom : top;
      return centre[0] == lower[0] ? left : right;
    };
    for (unsigned int i = 0; i < radial; ++i)
      result.edges.push_back({{{vertex(i, 0), vertex(i + 1, 0)}}, side_at(rays.front())});
    for (unsigned int i = radial; i-- > 0;)
      result.edges.push_back(
          {{{vertex(i + 1, n_rays - 1), vertex(i, n_rays - 1)}}, side_at(rays.back())});
  }
  return result;
}

namespace
{
void read_plate_with_hole(const Parameters &parameters, Geometry<2> &geometry)
{
  if (8. * geometry.subdivisions[0] * double(geometry.subdivisions[1]) > 1e6)
    parameters.reject("Geometry", "Subdivisions", too_many_cells);
  PlateWithHole plate{parameters.points<2>("Geometry", "Lower corner")[0],
                      parameters.points<2>("Geometry", "Upper corner")[0],
                      parameters.points<2>("Geometry", "Centre")[0],
                      parameters.number("Geometry", "Radius"),
                      parameters.text("Geometry", "Part") == "quarter",
                      geometry.subdivisions[0],
                      geometry.subdivisions[1]};
  if (!(plate.lower[0] < plate.upper[0] && plate.lower[1] < plate.upper[1]))
    parameters.reject("Geometry", "Upper corner",
                      "is not above and right of the lower corner " + to_string(plate.lower) +
                          "; enlarge every coordinate beyond it");
  if (!(plate.radius > 0))
    parameters.reject("Geometry", "Radius", "is no radius; give a positive number");
  double room = std::numeric_limits<double>::max();
  bool is_corner = true;
  for (unsigned int d = 0; d < 2; ++d)
  {
    const double below = plate.centre[d] - plate.lower[d], above = plate.upper[d] - plate.centre[d];
    is_corner = is_corner && (below == 0 || above == 0);
    room = std::min(room, plate.is_quarter ? std::max(below, above) : std::min(below, above));
  }
  if (plate.is_quarter && !is_corner)
    parameters.reject("Geometry", "Centre",
                      "is no corner of the plate, and Part = quarter has the hole at one; give a "
                      "corner or set Part = whole");
  if (!(plate.radius < room))
    parameters.reject("Geometry", "Radius",
                      "reaches a side of the plate, which is " + text(std::max(room, 0.), 6) +
                          " away from the centre of the hole; give less or move it");
  geometry.mesh = std::make_shared<const CoarseMesh>(plate.mesh());
}
} // namespace

ShapeKind<2> plate_with_hole_shape()
{
  return {Shape::plate_with_hole,
          "plate with hole",
          "plate with hole: between Lower corner and Upper corner, without the disc around Centre "
          "with Radius; its boundaries are left, right, bottom, top and hole.",
          {lower_corner_entry<2>(),
           upper_corner_entry<2>(),
           centre_entry(),
           radius_entry(),
           {"Geometry", "Part", "whole", std::make_shared<Patterns::Selection>("whole|quarter"),
            "whole or quarter",
            "Of a plate with a hole: the whole, with the hole inside, or a quarter, with Centre at "
            "one of its corners."}},
          "Radius",
          read_plate_with_hole,
          nullptr,
          [](const GeometryText &) {
            return SideNames{{"left", "right", "bottom", "top", "hole"}};
          },
          true};
}
} // namespace hpvi
