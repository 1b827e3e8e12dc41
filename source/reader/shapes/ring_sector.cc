// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/shapes/ring_sector.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

bool RingSector::is_closed() const
{
  return std::abs(to - from - 360) < 1e-9;
}

std::vector<std::string> RingSector::boundaries() const
{
  return is_closed() ? std::vector<std::string>{"inner", "outer"}
                     : std::vector<std::string>{"inner", "outer", "start", "end"};
}

CoarseMesh RingSector::mesh() const
{
  CoarseMesh result;
  result.boundaries = boundaries();
  const unsigned int n_rays = is_closed() ? angular : angular + 1;
  const auto angle = [&](const unsigned int j)
  { return (from + (to - from) * j / angular) * numbers::PI / 180; };
  const auto vertex = [&](const unsigned int i, const unsigned int j)
  { return i * n_rays + j % n_rays; };
  for (unsigned int i = 0; i <= radial; ++i)
    for (unsigned int j = 0; j < n_rays; ++j)
      result.vertices.push_back(
          Circle(centre, inner + (outer - inner) * i / radial).point(angle(j)));
  for (unsigned int i = 0; i < radial; ++i)
    for (unsigned int j = 0; j < angular; ++j)
      result.cells.push_back(
          {{{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}}});
  for (unsigned int i = 0; i <= radial; ++i)
  {
    const auto circle =
        std::make_shared<const Circle>(centre, inner + (outer - inner) * i / radial);
    for (unsigned int j = 0; j < angular; ++j)
      if (const unsigned int k = angular - 1 - j; i == 0) // counterclockwise around the body
        result.edges.push_back(
            {{{vertex(0, k + 1), vertex(0, k)}}, 0, {circle, angle(k + 1), angle(k)}});
      else
        result.edges.push_back({{{vertex(i, j), vertex(i, j + 1)}},
                                i == radial ? 1 : CoarseMesh::inside,
                                {circle, angle(j), angle(j + 1)}});
  }
  for (unsigned int i = 0; i < radial && !is_closed(); ++i)
    result.edges.push_back({{{vertex(i, 0), vertex(i + 1, 0)}}, 2});
  for (unsigned int i = radial; i-- > 0 && !is_closed();)
    result.edges.push_back({{{vertex(i + 1, angular), vertex(i, angular)}}, 3});
  return result;
}

namespace
{
/** Angles of a shape from the text of its entry, as far as it is one. */
std::array<double, 2> angles_in(const std::string &text)
{
  std::array<double, 2> result{{0, 90}};
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos)
    result = {{std::strtod(text.c_str(), nullptr), std::strtod(text.c_str() + comma + 1, nullptr)}};
  return result;
}

void read_ring_sector(const Parameters &parameters, Geometry<2> &geometry)
{
  if (geometry.subdivisions[0] * double(geometry.subdivisions[1]) > 1e6)
    parameters.reject("Geometry", "Subdivisions", too_many_cells);
  const Point<2> radii = parameters.points<2>("Geometry", "Radii")[0];
  if (!(0 < radii[0] && radii[0] < radii[1]))
    parameters.reject("Geometry", "Radii",
                      "are not ordered; give inner, outer with 0 < inner < outer");
  const std::array<double, 2> angles = angles_in(parameters.text("Geometry", "Angles"));
  if (!(angles[0] < angles[1] && angles[1] - angles[0] < 360 + 1e-9))
    parameters.reject("Geometry", "Angles",
                      "do not run counterclockwise by at most 360 degrees; give from, to with from "
                      "< to <= from + 360");
  const RingSector sector{parameters.points<2>("Geometry", "Centre")[0],
                          radii[0],
                          radii[1],
                          angles[0],
                          angles[1],
                          geometry.subdivisions[0],
                          geometry.subdivisions[1]};
  const double arc = (angles[1] - angles[0]) / sector.angular;
  if (arc > 90 + 1e-9 || (sector.is_closed() && sector.angular < 4))
    parameters.reject("Geometry", "Subdivisions",
                      "makes arcs of " + text(arc, 4) +
                          " degrees, and a cell turns by at most 90; give radial, angular with at "
                          "least " +
                          std::to_string(int(std::ceil((angles[1] - angles[0]) / 90 - 1e-9))) +
                          " angular cells");
  geometry.mesh = std::make_shared<const CoarseMesh>(sector.mesh());
}
} // namespace

ShapeKind<2> ring_sector_shape()
{
  return {Shape::ring_sector,
          "ring sector",
          "ring sector: between two circles around Centre, given by Radii and Angles; its "
          "boundaries are inner, outer, start and end.",
          {centre_entry(),
           {"Geometry", "Radii", "1, 2", point_pattern<2>(), "two numbers \"inner, outer\"",
            "Radii of the circles that bound a ring sector, inner, outer [length]."},
           {"Geometry", "Angles", "0, 90", point_pattern<2>(), "two numbers \"from, to\"",
            "Angles at which a ring sector starts and ends, counterclockwise from the x axis; 360 "
            "apart they make a closed ring without start and end [degrees]."}},
          "Radii",
          read_ring_sector,
          nullptr,
          [](const GeometryText &text)
          {
            const std::array<double, 2> angles = angles_in(text("Angles"));
            return SideNames{RingSector{{}, 1, 2, angles[0], angles[1]}.boundaries()};
          },
          true};
}
} // namespace hpvi
