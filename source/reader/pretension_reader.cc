// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/reader/grid_cuts.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/pretension_reader.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <limits>

namespace hpvi
{
using namespace dealii;

std::string section_of_pretension(const std::string &name)
{
  return "Pretension " + name;
}

std::vector<Entry> pretension_entries(const std::string &name)
{
  const std::string section = section_of_pretension(name);
  return {
      {section, "Through", "",
       word_or("", Patterns::List(Patterns::List(Patterns::Double(), 2, 2, ","), 2, 2, ";")),
       "two points x1, y1; x2, y2",
       "Ends of a straight cut through a bolt, from boundary to boundary, along edges of coarse "
       "cells; a box gets a grid line there. The bolt is shortened by as much as makes it "
       "carry Force. The cells on the left of the way from the first point to the second, "
       "down to a line parallel to the cut where cells end, take the shortening up, and nothing "
       "may load or rub their sides."},
      {section, "Force", "",
       word_or("", Patterns::Double(std::numeric_limits<double>::min(),
                                    std::numeric_limits<double>::max())),
       "a positive number",
       "Tension across the cut, in all: of Material/Thickness or of the full turn [stress "
       "length^2]. With Loading it is that of the first load step, whose shortening later "
       "ones keep: their force is a result."}};
}

namespace
{
/** What the file says of one. */
Pretension<2> read_cut(const Parameters &parameters, const std::string &name)
{
  const std::string section = section_of_pretension(name);
  const std::vector<Point<2>> ends = parameters.points<2>(section, "Through");
  if (ends.empty())
    parameters.reject(section, "Through",
                      "is missing; give the two ends of a cut through the bolt, x1, y1; x2, y2");
  if (parameters.text(section, "Force").empty())
    parameters.reject(section, "Force", "is missing; give the tension of the bolt");
  Pretension<2> cut;
  cut.name = name;
  cut.from = ends[0];
  cut.to = ends[1];
  cut.force = parameters.number(section, "Force");
  return cut;
}
} // namespace

void cut_at_pretensions(const Parameters &parameters, const std::vector<std::string> &names,
                        Scene<2> &body)
{
  const Geometry<2> &geometry = body.geometry;
  if (geometry.shape != Shape::box)
    return;
  const Point<2> lower = geometry.point({0., 0.}), upper = geometry.point({1., 1.});
  const double tolerance = same_place * geometry.diameter();
  for (const std::string &name : names)
  {
    const Pretension<2> cut = read_cut(parameters, name);
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double x = cut.from[d];
      if (std::abs(cut.to[d] - x) <= tolerance && x > lower[d] + tolerance &&
          x < upper[d] - tolerance &&
          std::max(cut.from[1 - d], cut.to[1 - d]) > lower[1 - d] + tolerance &&
          std::min(cut.from[1 - d], cut.to[1 - d]) < upper[1 - d] - tolerance)
        add_lines<2>(body, d, {(x - lower[d]) / (upper[d] - lower[d])},
                     section_of_pretension(name) + "/Through");
    }
  }
}

void read_pretensions(const Parameters &parameters, const std::vector<std::string> &names,
                      Scene<2> &scene)
{
  for (const std::string &name : names)
    if (const std::string flaw = add_pretension(scene, read_cut(parameters, name)); !flaw.empty())
      parameters.reject(section_of_pretension(name), "Through", flaw);
}
} // namespace hpvi
