// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/reader/body_reader.h>
#include <hpvi/reader/grid_cuts.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/space_pairs.h>
#include <hpvi/scene/boundary_parts.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A side of a body, or a part of one. */
struct SpaceSide
{
  unsigned int body, side;
  Expression<3> where = nullptr; ///< positive on the part; null: all of the side
};

std::optional<SpaceSide> whole_side(const std::string &name, const UserNames &names,
                                    const std::vector<Scene<3>> &singles)
{
  for (unsigned int b = 0; b < singles.size(); ++b)
  {
    const std::vector<std::string> sides = singles[b].geometry.boundary_names();
    for (unsigned int s = 0; s < sides.size(); ++s)
      if (names.bodies[b] + "." + sides[s] == name)
        return SpaceSide{b, s};
  }
  return std::nullopt;
}

SpaceSide side_in_space(const Parameters &parameters, const std::string &section,
                        const std::string &name, const UserNames &names,
                        const std::vector<Scene<3>> &singles)
{
  if (const auto side = whole_side(name, names, singles))
    return *side;
  if (std::find(names.parts.begin(), names.parts.end(), name) != names.parts.end())
    if (auto part = whole_side(parameters.text("Boundary " + name, "On"), names, singles))
    {
      part->where = read_where(parameters, "Boundary " + name,
                               sides_of(singles[part->body].geometry)[part->side].sample());
      return *part;
    }
  std::vector<std::string> all;
  for (unsigned int b = 0; b < singles.size(); ++b)
    for (const std::string &side : singles[b].geometry.boundary_names())
      all.push_back(names.bodies[b] + "." + side);
  parameters.reject(section, "Between",
                    "names " + printable(name) +
                        ", which is no side; this scene has: " + listed(all, "and"));
}

/** A rectangle across an axis, by its ends along each of the others. */
struct Rectangle
{
  unsigned int axis;
  Point<3> lower, upper;

  /** Positive inside, the distance to the nearest end [length]. */
  double inside(const Point<3> &x) const
  {
    double result = std::numeric_limits<double>::max();
    for (unsigned int d = 0; d < 3; ++d)
      if (d != axis)
        result = std::min({result, x[d] - lower[d], upper[d] - x[d]});
    return result;
  }
};

/** Of the box whose side it is. */
Rectangle rectangle_of(const Geometry<3> &geometry, const unsigned int side)
{
  return {side / 2, geometry.point({0., 0., 0.}), geometry.point({1., 1., 1.})};
}

/** Lines at the ends of @p part that lie inside of the box. */
void cut_box(Scene<3> &body, const Rectangle &part, const std::string &path)
{
  const Rectangle all = rectangle_of(body.geometry, 0);
  const Point<3> &low = all.lower, &high = all.upper;
  for (unsigned int d = 0; d < 3; ++d)
  {
    std::vector<double> lines;
    for (const double end : {part.lower[d], part.upper[d]})
      if (const double place = (end - low[d]) / (high[d] - low[d]);
          d != part.axis && place > same_place && place < 1 - same_place)
        lines.push_back(place);
    add_lines(body, d, lines, path);
  }
}

/** The number of `Closed within`, and a hair for round-off of distances. */
double read_closed_within(const Parameters &parameters, const std::string &section,
                          const double size)
{
  constexpr double most = 0.01;
  const double closed = parameters.number(section, "Closed within");
  if (closed > most * size)
    parameters.reject(section, "Closed within",
                      "is more than 1 % of the size of the bodies, " + to_string(size) +
                          "; give less, or move them together in the drawing");
  return closed > 0 ? closed + same_place * size : 0.;
}

/** Where both lie opposite to each other. */
Rectangle common_rectangle(const Parameters &parameters, const SpacePair &pair,
                           const std::vector<Scene<3>> &singles, const double hair)
{
  const Rectangle one = rectangle_of(singles[pair.bodies[0]].geometry, pair.sides[0]),
                  other = rectangle_of(singles[pair.bodies[1]].geometry, pair.sides[1]);
  Rectangle result = one;
  for (unsigned int d = 0; d < 3; ++d)
    if (d != one.axis)
    {
      result.lower[d] = std::max(one.lower[d], other.lower[d]);
      result.upper[d] = std::min(one.upper[d], other.upper[d]);
      if (result.upper[d] - result.lower[d] <= hair)
        parameters.reject(pair.section, "Between",
                          "names sides that lie beside each other; name two that lie opposite");
    }
  return result;
}

void find_distance(const Parameters &parameters, SpacePair &pair,
                   const std::vector<Scene<3>> &singles, const double size)
{
  const unsigned int axis = pair.sides[0] / 2;
  const auto place = [&](const unsigned int k)
  {
    const Rectangle all = rectangle_of(singles[pair.bodies[k]].geometry, pair.sides[k]);
    return (pair.sides[k] % 2 == 0 ? all.lower : all.upper)[axis];
  };
  pair.distance = (pair.sides[0] % 2 == 1 ? 1 : -1) * (place(1) - place(0));
  if (std::abs(pair.distance) <= same_place * size)
    pair.distance = 0;
  if (const double closed = read_closed_within(parameters, pair.section, size); closed > 0)
  {
    pair.closed = pair.section + "/Closed within: " + pair.called[0] + " and " + pair.called[1] +
                  " lie " + to_string(std::abs(pair.distance)) +
                  (pair.distance < 0 ? " inside each other" : " apart") +
                  " in the drawing, which " +
                  (std::abs(pair.distance) <= closed ? "counts as none" : "is more, and counts");
    if (std::abs(pair.distance) <= closed)
      pair.distance = 0;
  }
  if (pair.distance < 0)
    parameters.reject(pair.section, "Between",
                      "names sides that lie " + to_string(-pair.distance) +
                          " inside each other; move the bodies apart and give an interference as "
                          "a negative Gap, or set Closed within if none is meant");
}
} // namespace

SpacePair read_space_pair(const Parameters &parameters, const std::string &section,
                          const std::string &name, const UserNames &names,
                          std::vector<Scene<3>> &singles)
{
  const std::vector<std::string> sides =
      Utilities::split_string_list(parameters.text(section, "Between"), ',');
  if (sides == std::vector<std::string>{"automatic"})
    parameters.reject(section, "Between",
                      "finds sides in the plane alone; name two, BODY.side, BODY.side");
  if (sides.size() != 2)
    parameters.reject(section, "Between", "names no two sides; give BODY.side, BODY.side");
  SpacePair pair{name, section, {}, {}, {}, {}, 0, std::nullopt};
  std::array<Expression<3>, 2> parts;
  for (const unsigned int k : {0, 1})
  {
    const SpaceSide side = side_in_space(parameters, section, sides[k], names, singles);
    pair.bodies[k] = side.body;
    pair.sides[k] = side.side;
    pair.called[k] = sides[k];
    parts[k] = side.where;
  }
  if (pair.bodies[0] == pair.bodies[1])
    parameters.reject(section, "Between",
                      "names sides of one body; a body does not touch itself, name sides of two");
  if (const std::string slave = parameters.text(section, "Slave"); slave != "automatic")
  {
    const auto found = std::find(sides.begin(), sides.end(), slave);
    if (found == sides.end())
      parameters.reject(section, "Slave",
                        "is none of the two sides; give automatic or one of Between");
    pair.slave = found - sides.begin();
  }
  for (const unsigned int b : pair.bodies)
    if (singles[b].geometry.shape != Shape::box)
      parameters.reject(section, "Between",
                        "names a side of Body " + names.bodies[b] +
                            ", which is no box; bodies in space that touch are boxes, set its "
                            "Shape = box");
  if (pair.sides[0] / 2 != pair.sides[1] / 2 || pair.sides[0] == pair.sides[1])
    parameters.reject(section, "Between",
                      "names sides that do not face each other; name two that lie opposite");
  const double size = std::max(singles[pair.bodies[0]].geometry.diameter(),
                               singles[pair.bodies[1]].geometry.diameter());
  const Rectangle both = common_rectangle(parameters, pair, singles, same_place * size);
  find_distance(parameters, pair, singles, size);
  for (const unsigned int k : {0, 1})
  {
    cut_box(singles[pair.bodies[k]], both, section + "/Between");
    pair.where[k] = expression<3>(
        [both, part = parts[k], other = parts[1 - k]](const Point<3> &x)
        {
          const bool is_part = (!part || part->value(x) > 0) && (!other || other->value(x) > 0);
          return is_part ? both.inside(x) : -1.;
        });
  }
  return pair;
}

void add_parts(const SpacePair &read, Scene<3> &scene)
{
  ContactPair pair{read.name, {}, {}, read.slave};
  for (const unsigned int k : {0, 1})
  {
    BoundaryCondition<3> part;
    pair.sides[k] = scene.geometry.bodies[read.bodies[k]].sides[read.sides[k]];
    const std::vector<CoarseFace<3>> faces = coarse_faces(scene.geometry, pair.sides[k]);
    const bool is_whole = std::all_of(faces.begin(), faces.end(),
                                      [&](const CoarseFace<3> &face)
                                      { return read.where[k]->value(middle_of(face)) > 0; });
    part.name = read.called[k] + (is_whole ? "" : " (" + read.name + ")");
    part.id = pair.parts[k] = scene.boundaries.size();
    part.side = pair.sides[k];
    part.where = read.where[k];
    part.pair = scene.pairs.size();
    part.pair_name = read.name;
    part.gap = read.distance > 0 ? expression<3>(read.distance) : nullptr;
    scene.boundaries.push_back(part);
  }
  scene.pairs.push_back(pair);
}
} // namespace hpvi
