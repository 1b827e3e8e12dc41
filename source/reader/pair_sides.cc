// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/reader/body_reader.h>
#include <hpvi/reader/grid_cuts.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/pair_rules.h>
#include <hpvi/reader/pair_sides.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/edge_projection.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace hpvi
{
using namespace dealii;

namespace
{
NamedSide side_called(const Parameters &parameters, const std::string &section,
                      const std::string &name, const std::vector<NamedSide> &sides,
                      const std::vector<Scene<2>> &singles)
{
  std::vector<std::string> all;
  for (const NamedSide &side : sides)
    if (side.name == name)
      return side;
    else
      all.push_back(side.name);
  for (const NamedSide &side : sides)
    if (const auto &mesh = singles[side.body].geometry.mesh; mesh && !side.where)
    {
      const std::string body = side.name.substr(0, side.name.find('.'));
      for (const std::string &curve : mesh->interfaces)
        if (body + "." + curve == name)
          parameters.reject(section, "Between",
                            "names " + printable(name) + ", a curve inside of body " + body +
                                "; let each side of it be a Body NAME, by its Surfaces, and name "
                                "the boundaries of these");
    }
  parameters.reject(section, "Between",
                    "names " + printable(name) +
                        ", which is no side; this scene has: " + listed(all, "and"));
}

/** Edge by edge, if it is a part. */
Side<2> side_of(const NamedSide &named, const Geometry<2> &geometry)
{
  Side<2> result = sides_of(geometry)[named.side];
  if (!named.where)
    return result;
  result.pieces.clear();
  result.curves.clear();
  for (const CoarseFace<2> &face : coarse_faces(geometry, named.side))
    if (named.has(face))
    {
      result.pieces.push_back(face.corners);
      result.curves.push_back(face.curve);
    }
  return result;
}

std::array<std::string, 2> names_of(const PairSides &pair)
{
  return {{pair.sides[0].name, pair.sides[1].name}};
}

/** What is positive where @p facing is, in the part. */
Expression<2> inside_of(const FacingPart &facing, const Expression<2> &part = nullptr)
{
  return expression<2>([facing, part](const Point<2> &x)
                       { return part && part->value(x) <= 0 ? -1. : facing.inside(x); });
}

// Straight sides that are parallel have the ends of both along one line.
void cut_at_ends(const Parameters &parameters, const FacingPart &facing, PairSides &pair,
                 std::vector<Scene<2>> &singles)
{
  std::array<bool, 2> hangs_over{{false, false}};
  for (const unsigned int k : {0, 1})
  {
    FacingPart own = facing;
    Scene<2> &body = singles[pair.sides[k].body];
    cut_side<2>(body, pair.sides[k].side, inside_of(facing), pair.section + "/Between");
    for (const CoarseFace<2> &face : coarse_faces(body.geometry, pair.sides[k].side))
    {
      if (!pair.sides[k].has(face))
        continue;
      const double one = facing.along * face.corners[0], two = facing.along * face.corners[1],
                   begin = std::min(one, two), end = std::max(one, two),
                   hair = same_on_edge * (end - begin);
      if (end < facing.begin + hair || begin > facing.end - hair)
        continue;
      if (begin < facing.begin - hair || end > facing.end + hair)
        hangs_over[k] = true;
      own.begin = std::min(own.begin, begin);
      own.end = std::max(own.end, end);
    }
    pair.where[k] = inside_of(own, pair.sides[k].where);
    pair.distance[k] = facing.distance > 0 ? expression<2>(facing.distance) : nullptr;
  }
  choose_slave(parameters, pair.section, hangs_over, pair.slave);
  pair.line = facing;
}

} // namespace

bool NamedSide::has(const CoarseFace<2> &face) const
{
  return !where || where->value(middle_of(face)) > 0;
}

std::vector<NamedSide> named_sides(const Parameters &parameters, const UserNames &names,
                                   const std::vector<Scene<2>> &singles)
{
  std::vector<NamedSide> result;
  for (unsigned int b = 0; b < singles.size(); ++b)
  {
    const std::vector<std::string> sides = singles[b].geometry.boundary_names();
    for (unsigned int s = 0; s < sides.size(); ++s)
      if (!sides[s].empty())
        result.push_back({names.bodies[b] + "." + sides[s], b, s});
  }
  const std::vector<NamedSide> whole = result;
  for (const std::string &name : names.parts)
  {
    const std::string section = "Boundary " + name, on = parameters.text(section, "On");
    const auto side = std::find_if(whole.begin(), whole.end(),
                                   [&](const NamedSide &one) { return one.name == on; });
    if (side == whole.end())
      continue; // read_body() says so
    const Geometry<2> &geometry = singles[side->body].geometry;
    const NamedSide part{name, side->body, side->side,
                         read_where(parameters, section, sides_of(geometry)[side->side].sample())};
    if (side_of(part, geometry).pieces.empty())
      parameters.reject(section, "Where",
                        "is positive nowhere on " + on +
                            "; give a function that is positive on the part");
    result.push_back(part);
  }
  return result;
}

PairSides read_pair_sides(const Parameters &parameters, const std::string &section,
                          const std::string &name, const std::vector<NamedSide> &all,
                          std::vector<Scene<2>> &singles)
{
  const std::array<std::string, 2> sides = read_between(parameters, section);
  PairSides pair{name, section, {}, {}, {}, {}};
  for (const unsigned int k : {0, 1})
    pair.sides[k] = side_called(parameters, section, sides[k], all, singles);
  pair.slave = read_slave(parameters, section, sides, pair.sides[0].body == pair.sides[1].body);
  const auto side = [&](const unsigned int k)
  { return side_of(pair.sides[k], singles[pair.sides[k].body].geometry); };
  const double size = std::max(singles[pair.sides[0].body].geometry.diameter(),
                               singles[pair.sides[1].body].geometry.diameter());
  std::string problem;
  std::optional<FacingPart> facing = contact_search(side(0), side(1), size, problem);
  if (!problem.empty())
    parameters.reject(section, "Between",
                      "names sides that " + problem + "; name two that lie opposite");
  const double closed = read_closed_within(parameters, section, size);
  if (facing && closed > 0)
  {
    pair.closed =
        closed_in_words(section, names_of(pair), closed, facing->distance, facing->distance);
    if (std::abs(facing->distance) <= closed)
      facing->distance = 0;
  }
  if (facing && facing->distance < 0)
    reject_overlap(parameters, section, -facing->distance, "");
  if (facing)
    cut_at_ends(parameters, *facing, pair, singles);
  return pair;
}

namespace
{
/** Of straight sides of boxes; did any line go on? */
bool carry_on_cuts(const PairSides &pair, std::vector<Scene<2>> &singles)
{
  const std::array<Scene<2> *, 2> bodies{
      {&singles[pair.sides[0].body], &singles[pair.sides[1].body]}};
  if (!pair.line || bodies[0]->geometry.shape != Shape::box ||
      bodies[1]->geometry.shape != Shape::box)
    return false;
  const unsigned int along = std::abs(pair.line->along[0]) > 0.5 ? 0 : 1;
  std::array<std::vector<double>, 2> missing; // of either body, in its unit cube
  for (const unsigned int k : {0, 1})
  {
    const Geometry<2> &own = bodies[k]->geometry, &other = bodies[1 - k]->geometry;
    const double low = own.corners.front()[along], length = own.corners.back()[along] - low,
                 hair = same_place * std::max(own.diameter(), other.diameter());
    const std::vector<double> lines = own.grid_lines(along), &cuts = other.cuts[along];
    for (const double line : other.grid_lines(along))
    {
      const Point<2> x = other.point({line, line});
      const double here = (x[along] - low) / length;
      if (pair.line->inside(x) < hair ||
          std::any_of(lines.begin(), lines.end(),
                      [&](const double one) { return std::abs(one - here) * length < hair; }))
        continue;
      if (std::find(cuts.begin(), cuts.end(), line) == cuts.end())
        return false;
      missing[k].push_back(here);
    }
  }
  for (const unsigned int k : {0, 1})
    add_lines(*bodies[k], along, missing[k], pair.section + "/Between");
  return !missing[0].empty() || !missing[1].empty();
}
} // namespace

void carry_on_cuts(const std::vector<PairSides> &pairs, std::vector<Scene<2>> &singles)
{
  for (bool is_changed = true; is_changed;)
  {
    is_changed = false;
    for (const PairSides &pair : pairs)
      is_changed = carry_on_cuts(pair, singles) || is_changed;
  }
}

void match_edges(const Parameters &parameters, std::vector<Scene<2>> &singles, PairSides &pair)
{
  const auto drawn = [&](const unsigned int k)
  {
    const NamedSide &side = pair.sides[k];
    return ExactSide(singles[side.body].geometry, side.side, side.where);
  };
  const std::array<ExactSide, 2> sides{{drawn(0), drawn(1)}};
  const auto diameter = [&](const unsigned int k)
  { return singles[pair.sides[k].body].geometry.diameter(); };
  const double smaller = std::min(diameter(0), diameter(1)),
               size = std::max(diameter(0), diameter(1));
  std::string problem;
  const ProjectedEdges edges = edge_projection(sides, pair.slave, smaller, problem);
  if (edges.is_empty())
    parameters.reject(pair.section, pair.slave ? "Slave" : "Between",
                      std::string(pair.slave ? "is one of two sides that " : "names sides that ") +
                          problem +
                          (pair.slave ? "; name the other one or set automatic"
                                      : "; name two that lie opposite, or parts of them, or give "
                                        "them vertices where they do"));
  const double closed = read_closed_within(parameters, pair.section, size),
               within = std::max(closed, same_place * size);
  // Curves that meet, and lie inside each other by no more than splines leave open between their points.
  const bool is_in_doubt =
      edges.least < -within && edges.largest >= -within && edges.least_for_sure >= 0;
  if (edges.least < -within && !is_in_doubt)
    reject_overlap(parameters, pair.section, -edges.least, " at " + to_string(edges.at_least));
  const bool touches = edges.largest <= (is_in_doubt ? edges.doubt : within);
  if (is_in_doubt)
    singles[pair.sides[0].body].remarks.push_back(
        pair.section + ": " + pair.sides[0].name + " and " + pair.sides[1].name + " lie up to " +
        to_string(-edges.least) + " inside each other, at " + to_string(edges.at_least) +
        ", less than splines through their vertices leave open, " + to_string(edges.doubt) +
        (touches ? ": that counts as touching" : ": that depth counts as none"));
  if (closed > 0)
    pair.closed = closed_in_words(pair.section, names_of(pair), closed, edges.least, edges.largest);
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
    pair.distance[k] = touches ? nullptr
                               : beyond<2>(closed, is_in_doubt ? -edges.least : 0,
                                           distance_along_normal(sides[k], sides[1 - k]));
    pair.where[k] = expression<2>(
        [side = sides[k], part = pair.sides[k].where, own = edges.in_pair[k]](const Point<2> &x)
        { return (!part || part->value(x) > 0) && own[side.nearest_edge(x)] ? 1. : -1.; });
  }
}

void check_overlap(const Parameters &parameters, const std::vector<PairSides> &pairs)
{
  for (const PairSides &one : pairs)
    for (const PairSides &other : pairs)
      for (const NamedSide &side : one.sides)
        for (const NamedSide &same : other.sides)
        {
          if (&one <= &other || side.body != same.body || side.side != same.side || !one.line ||
              !other.line)
            continue; // of others check_parts() finds it
          // Along one line, whose direction may be either.
          const double sign = one.line->along * other.line->along > 0 ? 1 : -1;
          const double begin = std::min(sign * other.line->begin, sign * other.line->end),
                       end = std::max(sign * other.line->begin, sign * other.line->end);
          if (std::min(end, one.line->end) - std::max(begin, one.line->begin) >
              same_on_edge * (end - begin))
            parameters.reject(one.section, "Between",
                              "has edges of " + side.name + " that Contact " + other.name +
                                  " has, too; let each edge touch one body");
        }
}

namespace
{
/** Of the side, or part, where all of it is in the pair; else it needs one of its own, for the rest has that. */
std::string name_of_part(const PairSides &read, const unsigned int k, const unsigned int side,
                         const Scene<2> &scene)
{
  const std::vector<CoarseFace<2>> faces = coarse_faces(scene.geometry, side);
  const bool is_whole =
      std::all_of(faces.begin(), faces.end(),
                  [&](const CoarseFace<2> &face) {
                    return !read.sides[k].has(face) || read.where[k]->value(middle_of(face)) > 0;
                  });
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
