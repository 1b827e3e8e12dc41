// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/input/parameters.h>
#include <hpvi/reader/grid_cuts.h>
#include <hpvi/reader/pair_sides.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/opposite_edges.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double same_place = 1e-9; ///< of the size of the bodies

NamedSide side_called(const Parameters &parameters, const std::string &section,
                      const std::string &name, const std::vector<std::string> &bodies,
                      const std::vector<Scene<2>> &singles)
{
  std::vector<std::string> all;
  for (unsigned int b = 0; b < bodies.size(); ++b)
  {
    const std::vector<std::string> sides = singles[b].geometry.boundary_names();
    for (unsigned int s = 0; s < sides.size(); ++s)
      if (bodies[b] + "." + sides[s] == name)
        return {name, b, s};
      else if (!sides[s].empty())
        all.push_back(bodies[b] + "." + sides[s]);
  }
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (singles[b].geometry.mesh)
      for (const std::string &curve : singles[b].geometry.mesh->interfaces)
        if (bodies[b] + "." + curve == name)
          parameters.reject(section, "Between",
                            "names " + printable(name) + ", a curve inside of body " + bodies[b] +
                                "; let each side of it be a Body NAME, by its Surfaces, and name "
                                "the boundaries of these");
  parameters.reject(section, "Between",
                    "names " + printable(name) +
                        ", which is no side; this scene has: " + listed(all, "and"));
}

void reject_overlap(const Parameters &parameters, const std::string &section, const double depth)
{
  parameters.reject(section, "Between",
                    "names sides that lie " + to_string(depth) +
                        " inside each other; move the bodies apart and give an interference as a "
                        "negative Gap, or set Closed within if none is meant");
}

/** The number of `Closed within`. */
double read_closed(const Parameters &parameters, const std::string &section, const double size)
{
  constexpr double most = 0.01;
  const double closed = parameters.number(section, "Closed within");
  if (closed > most * size)
    parameters.reject(section, "Closed within",
                      "is more than 1 % of the size of the bodies, " + to_string(size) +
                          "; give less, or move them together in the drawing");
  return closed;
}

/** What counts as none of distances from @p least to @p largest, negative where sides lie inside each other. */
std::string closed_in_words(const PairSides &pair, const double closed, const double least,
                            const double largest)
{
  const std::string sides = pair.sides[0].name + " and " + pair.sides[1].name,
                    entry = pair.section + "/Closed within = " + to_string(closed);
  if (largest - least <= 1e-6 * closed && std::abs(least) <= closed)
    return entry + ": " + sides + " lie " + to_string(std::abs(least)) +
           (least < 0 ? " inside each other" : " apart") + " in the drawing, which counts as none";
  const std::string distances = entry + ": distances of " + sides + " in the drawing, from " +
                                to_string(least) + " to " + to_string(largest) + ", ";
  return distances + (least > closed                          ? "are all larger, and count"
                      : -least <= closed && largest <= closed ? "count as none"
                                                              : "count as none up to it");
}

Expression<2> inside_of(const FacingSides &facing)
{
  return expression<2>([facing](const Point<2> &x) { return facing.inside(x); });
}

// Straight sides that are parallel have the ends of both along one line.
void cut_at_ends(const Parameters &parameters, const FacingSides &facing, PairSides &pair,
                 std::vector<Scene<2>> &singles)
{
  std::array<bool, 2> hangs_over{{false, false}};
  for (const unsigned int k : {0, 1})
  {
    FacingSides own = facing;
    Scene<2> &body = singles[pair.sides[k].body];
    cut_side<2>(body, pair.sides[k].side, inside_of(facing), pair.section + "/Between");
    for (const CoarseFace<2> &face : coarse_faces(body.geometry, pair.sides[k].side))
    {
      const double one = facing.along * face.corners[0], two = facing.along * face.corners[1],
                   begin = std::min(one, two), end = std::max(one, two),
                   hair = 1e-9 * (end - begin);
      if (end < facing.begin + hair || begin > facing.end - hair)
        continue;
      if (begin < facing.begin - hair || end > facing.end + hair)
        hangs_over[k] = true;
      own.begin = std::min(own.begin, begin);
      own.end = std::max(own.end, end);
    }
    pair.where[k] = inside_of(own);
    pair.distance[k] = facing.distance > 0 ? expression<2>(facing.distance) : nullptr;
  }
  if (hangs_over[0] && hangs_over[1])
    parameters.reject(pair.section, "Between",
                      "has edges of both sides that hang over the end of the other; give one body "
                      "a vertex where the other ends, by its Subdivisions");
  for (const unsigned int k : {0, 1})
    if (hangs_over[k] && pair.slave == k)
      parameters.reject(pair.section, "Slave",
                        "has an edge that hangs over the end of the other side; give it a vertex "
                        "there, or set automatic");
    else if (hangs_over[k])
      pair.slave = 1 - k;
  pair.line = facing;
}

/** @p distance, but 0 up to @p closed. */
Expression<2> beyond(const double closed, const Expression<2> &distance)
{
  if (closed == 0)
    return distance;
  return expression<2>(std::function<double(const Point<2> &)>(
      [closed, distance](const Point<2> &x)
      {
        const double value = distance->value(x);
        return std::abs(value) <= closed ? 0. : value;
      }));
}

/** Edge by edge, where sides are curved or at an angle to each other. */
void match_edges(const Parameters &parameters, const double size, const double closed,
                 PairSides &pair, std::vector<Scene<2>> &singles)
{
  const auto drawn = [&](const unsigned int k)
  { return DrawnSide(singles[pair.sides[k].body].geometry, pair.sides[k].side); };
  const std::array<DrawnSide, 2> sides{{drawn(0), drawn(1)}};
  std::string problem;
  const double smaller = std::min(singles[pair.sides[0].body].geometry.diameter(),
                                  singles[pair.sides[1].body].geometry.diameter());
  const OppositeEdges edges = opposite_edges(sides, pair.slave, smaller, problem);
  if (edges.is_empty())
    parameters.reject(pair.section, pair.slave ? "Slave" : "Between",
                      std::string(pair.slave ? "is one of two sides that " : "names sides that ") +
                          problem +
                          (pair.slave ? "; name the other one or set automatic"
                                      : "; name two that lie opposite, or give them vertices "
                                        "where they do"));
  const double within = std::max(closed, same_place * size);
  if (edges.least < -within)
    reject_overlap(parameters, pair.section, -edges.least);
  const bool touches = edges.largest <= within;
  if (closed > 0)
    pair.closed = closed_in_words(pair, closed, edges.least, edges.largest);
  if (const auto &left_out = edges.left_out; left_out.number > 0)
  {
    const NamedSide &side = pair.sides[edges.slave.value_or(0)];
    singles[side.body].remarks.push_back(
        pair.section + " leaves out " + std::to_string(left_out.number) +
        (left_out.number > 1 ? " edges of " : " edge of ") + side.name +
        ", of which a part alone lies opposite, " + to_string(left_out.distance) +
        " away or more, the nearest at " + to_string(left_out.at));
  }
  pair.slave = edges.slave;
  for (const unsigned int k : {0, 1})
  {
    pair.distance[k] =
        touches ? nullptr : beyond(closed, distance_along_normal(sides[k], sides[1 - k]));
    pair.where[k] = expression<2>([side = sides[k], own = edges.in_pair[k]](const Point<2> &x)
                                  { return own[side.nearest_edge(x)] ? 1. : -1.; });
  }
}
} // namespace

PairSides read_pair_sides(const Parameters &parameters, const std::string &section,
                          const std::string &name, const std::vector<std::string> &bodies,
                          std::vector<Scene<2>> &singles)
{
  const std::vector<std::string> sides =
      Utilities::split_string_list(parameters.text(section, "Between"), ',');
  if (sides.size() != 2)
    parameters.reject(section, "Between", "names no two sides; give BODY.side, BODY.side");
  PairSides pair{name, section, {}, {}, {}, {}};
  for (const unsigned int k : {0, 1})
    pair.sides[k] = side_called(parameters, section, sides[k], bodies, singles);
  if (pair.sides[0].body == pair.sides[1].body)
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
  const auto side_of = [&](const unsigned int k)
  { return sides_of(singles[pair.sides[k].body].geometry)[pair.sides[k].side]; };
  const double size = std::max(singles[pair.sides[0].body].geometry.diameter(),
                               singles[pair.sides[1].body].geometry.diameter());
  std::string problem;
  std::optional<FacingSides> facing = facing_sides(side_of(0), side_of(1), size, problem);
  if (!problem.empty())
    parameters.reject(section, "Between",
                      "names sides that " + problem + "; name two that lie opposite");
  const double closed = read_closed(parameters, section, size);
  if (facing && closed > 0)
  {
    pair.closed = closed_in_words(pair, closed, facing->distance, facing->distance);
    if (std::abs(facing->distance) <= closed)
      facing->distance = 0;
  }
  if (!facing)
    match_edges(parameters, size, closed, pair, singles);
  else if (facing->distance < 0)
    reject_overlap(parameters, section, -facing->distance);
  else
    cut_at_ends(parameters, *facing, pair, singles);
  return pair;
}

void check_overlap(const Parameters &parameters, const std::vector<PairSides> &pairs)
{
  for (const PairSides &one : pairs)
    for (const PairSides &other : pairs)
      for (const NamedSide &side : one.sides)
        for (const NamedSide &same : other.sides)
        {
          if (&one <= &other || side.name != same.name || !one.line || !other.line)
            continue; // of others check_parts() finds it
          // Along one line, whose direction may be either.
          const double sign = one.line->along * other.line->along > 0 ? 1 : -1;
          const double begin = std::min(sign * other.line->begin, sign * other.line->end),
                       end = std::max(sign * other.line->begin, sign * other.line->end);
          if (std::min(end, one.line->end) - std::max(begin, one.line->begin) >
              1e-9 * (end - begin))
            parameters.reject(one.section, "Between",
                              "has edges of " + side.name + " that Contact " + other.name +
                                  " has, too; let each edge touch one body");
        }
}

namespace
{
/** Of the side where all of it is in the pair; else it needs one of its own, for the rest of the side has that. */
std::string name_of_part(const PairSides &read, const unsigned int k, const unsigned int side,
                         const Scene<2> &scene)
{
  const std::vector<CoarseFace<2>> faces = coarse_faces(scene.geometry, side);
  const bool is_whole = std::all_of(faces.begin(), faces.end(),
                                    [&](const CoarseFace<2> &face)
                                    { return read.where[k]->value(middle_of(face)) > 0; });
  return read.sides[k].name + (is_whole ? "" : " (" + read.name + ")");
}
} // namespace

void add_parts(const PairSides &read, Scene<2> &scene)
{
  ContactPair pair{read.name, {}, {}, read.slave};
  for (const unsigned int k : {0, 1})
  {
    BoundaryCondition<2> part;
    pair.sides[k] = scene.geometry.bodies[read.sides[k].body].sides[read.sides[k].side];
    part.name = name_of_part(read, k, pair.sides[k], scene);
    part.id = pair.parts[k] = scene.boundaries.size();
    part.side = pair.sides[k];
    part.where = read.where[k];
    part.pair = scene.pairs.size();
    part.pair_name = read.name;
    part.gap = read.distance[k];
    scene.boundaries.push_back(part);
  }
  scene.pairs.push_back(pair);
}
} // namespace hpvi
