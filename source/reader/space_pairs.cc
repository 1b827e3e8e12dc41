// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/reader/body_reader.h>
#include <hpvi/reader/grid_cuts.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/pair_rules.h>
#include <hpvi/reader/space_pairs.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/box_tree.h>
#include <hpvi/scene/curved_facing.h>
#include <hpvi/scene/faces_across.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <tuple>
#include <utility>

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

/** Coarse faces of a side, before bodies are one geometry. */
struct SideFaces
{
  std::vector<Side<3>::Piece> all, named; ///< named: those of the part that `Between` names
  std::vector<unsigned int> number;       ///< of these among all
  std::vector<CurvedFace> curves;         ///< of all, where plane ones are curved as well
  bool is_curved = false;                 ///< is any cell of second order?
};

SideFaces faces_of(const SpacePair &pair, const unsigned int k,
                   const std::vector<Scene<3>> &singles)
{
  SideFaces result;
  for (const CoarseFace<3> &face : coarse_faces(singles[pair.bodies[k]].geometry, pair.sides[k]))
  {
    Side<3>::Piece piece = face.corners;
    if (normal_of(piece) * (middle_of(face) - face.inside) < 0) // as those of a grid may be
      std::swap(piece[1], piece[2]);
    if (const Expression<3> &part = pair.part[k]; !part || part->value(middle_of(face)) > 0)
    {
      result.named.push_back(piece);
      result.number.push_back(result.all.size());
    }
    result.all.push_back(piece);
    result.curves.push_back(face.curve ? face.curve : flat_face(piece));
    result.is_curved = result.is_curved || face.curve;
  }
  return result;
}

/** Lines of a box where the other side ends, along the axes of the side. */
void cut_box(Scene<3> &body, const unsigned int side, const std::vector<Side<3>::Piece> &other,
             const std::string &path)
{
  const Point<3> low = body.geometry.point({0., 0., 0.}), high = body.geometry.point({1., 1., 1.});
  for (unsigned int d = 0; d < 3; ++d)
  {
    if (d == side / 2)
      continue;
    std::array<double, 2> ends{{high[d], low[d]}};
    for (const Side<3>::Piece &face : other)
      for (const Point<3> &corner : face)
        ends = {{std::min(ends[0], corner[d]), std::max(ends[1], corner[d])}};
    std::vector<double> lines;
    for (const double end : ends)
      if (const double place = (end - low[d]) / (high[d] - low[d]);
          place > same_place && place < 1 - same_place)
        lines.push_back(place);
    add_lines(body, d, lines, path);
  }
}

/** Of many faces that of a point. */
class FaceFinder
{
public:
  explicit FaceFinder(const std::vector<Side<3>::Piece> &faces) : faces(faces), tree(boxes(faces))
  {
  }

  unsigned int face_at(const Point<3> &x) const
  {
    return tree.nearest(x, [&](const unsigned int f) { return distance(faces[f], x); });
  }

private:
  static std::vector<BoundingBox<3>> boxes(const std::vector<Side<3>::Piece> &faces)
  {
    std::vector<BoundingBox<3>> result;
    for (const Side<3>::Piece &face : faces)
      result.emplace_back(std::vector<Point<3>>(face.begin(), face.end()));
    return result;
  }

  const std::vector<Side<3>::Piece> faces;
  const BoxTree<3> tree;
};

/** Which faces are in the pair, as a function that is positive there, and the distance to what is opposite. */
void place_pair(SpacePair &pair, const unsigned int k, const SideFaces &own,
                const SidesFacing &facing, const double closed, const bool touches)
{
  const auto finder = std::make_shared<const FaceFinder>(own.all);
  std::vector<SidesFacing::Face> opposite(own.all.size());
  for (unsigned int f = 0; f < own.number.size(); ++f)
    opposite[own.number[f]] = facing.faces[f];
  pair.where[k] =
      expression<3>([finder, opposite](const Point<3> &x)
                    { return opposite[finder->face_at(x)].covered > uncovered_share ? 1. : -1.; });
  if (touches)
    return;
  if (facing.largest - facing.least <= 1e-12 * facing.largest)
    pair.distance[k] = expression<3>(facing.least);
  else
    pair.distance[k] = beyond<3>(closed, 0.,
                                 expression<3>(std::function<double(const Point<3> &)>(
                                     [finder, opposite](const Point<3> &x)
                                     {
                                       const SidesFacing::Face &face = opposite[finder->face_at(x)];
                                       return face.slope * (x - face.at);
                                     })));
}

/** Of a pair that is curved, what each side sees of the other. */
struct CurvedSides
{
  explicit CurvedSides(const std::array<SideFaces, 2> &sides)
      : faces{{named(sides[0]), named(sides[1])}}, facing{{CurvedFacing(faces[0], faces[1]),
                                                           CurvedFacing(faces[1], faces[0])}}
  {
  }

  static CurvedFaces named(const SideFaces &side)
  {
    std::vector<CurvedFace> result;
    for (const unsigned int f : side.number)
      result.push_back(side.curves[f]);
    return CurvedFaces(std::move(result));
  }

  std::array<CurvedFaces, 2> faces;
  std::array<CurvedFacing, 2> facing;
};

/**
 * Where its own normal at @p x leads from one side to the other [length]; at the rim, where it leads past the end of that, @p far.
 */
Expression<3> distance_between(const CurvedFaces &own, const CurvedFaces &other, const double far)
{
  return expression<3>(std::function<double(const Point<3> &)>(
      [own, other, far](const Point<3> &x)
      {
        const CurvedFace &face = own[own.nearest(x)];
        const auto there = other.opposite(x, face.normal(face.nearest(x)));
        return there ? there->at.distance : far;
      }));
}

/**
 * Faces of a curved side of which a part alone has something opposite hang over the end of the other side, and make theirs the master;
 * beyond @p reach nobody touches them, and they are left out.
 */
bool hangs_over(const CurvedFacing &facing, const double reach)
{
  return std::none_of(facing.faces.begin(), facing.faces.end(),
                      [](const CurvedFacing::Face &face) { return face.is_covered(); }) ||
         std::any_of(facing.faces.begin(), facing.faces.end(),
                     [&](const CurvedFacing::Face &face)
                     { return face.covered > 0 && !face.is_covered() && face.least < reach; });
}

/**
 * What a circle through the nodes of an edge leaves open between them, `s^3/L^2` with the height s over the chord L, the largest of all
 * edges and lines in the middle of faces [length].
 */
double left_open(const CurvedFaces &side)
{
  double result = 0;
  for (unsigned int f = 0; f < side.size(); ++f)
  {
    const CurvedFace::Nodes &nodes = side[f].nodes();
    for (const auto &[along, across] : {std::pair(1, 3), {3, 1}})
      for (int line = 0; line < 3; ++line)
      {
        const Point<3> *const p = &nodes[across * line];
        const Tensor<1, 3> chord = p[2 * along] - p[0], height = p[along] - (p[0] + chord / 2.);
        result = std::max(result, std::pow(height.norm(), 3) / chord.norm_square());
      }
  }
  return result;
}

[[noreturn]] void reject_beside(const Parameters &parameters, const std::string &section,
                                const bool look_at_each_other)
{
  parameters.reject(section, "Between",
                    std::string("names sides that ") +
                        (look_at_each_other ? "lie beside" : "do not face") +
                        " each other; name two that lie opposite");
}

void match_curved_faces(const Parameters &parameters, const std::array<SideFaces, 2> &sides,
                        const double size, const double smaller, SpacePair &pair)
{
  constexpr double touching = 0.02; // of the size of the smaller body
  const bool has_faces = !sides[0].number.empty() && !sides[1].number.empty();
  const auto curved = has_faces ? std::make_unique<const CurvedSides>(sides) : nullptr;
  if (!curved || !curved->facing[0].any() || !curved->facing[1].any())
    reject_beside(parameters, pair.section, false);
  choose_slave(parameters, pair.section,
               {{hangs_over(curved->facing[0], touching * smaller),
                 hangs_over(curved->facing[1], touching * smaller)}},
               pair.slave);
  const CurvedFacing &seen = curved->facing[pair.slave.value_or(0)];
  CurvedFacing::Face all;
  for (const CurvedFacing::Face &face : seen.faces)
    if (face.is_covered())
    {
      all.largest = std::max(all.largest, face.largest);
      if (face.least < all.least)
        std::tie(all.least, all.at_least) = std::tie(face.least, face.at_least);
    }
  const double closed = read_closed_within(parameters, pair.section, size),
               within = std::max(closed, same_place * size);
  // Faces that meet, and lie inside each other by no more than circles through their nodes leave open.
  const double doubt = left_open(curved->faces[0]) + left_open(curved->faces[1]);
  const bool is_in_doubt = all.least < -within && all.least >= -doubt;
  if (all.least < -within && !is_in_doubt)
    reject_overlap(parameters, pair.section, -all.least, " at " + to_string(all.at_least));
  const bool touches = all.largest <= (is_in_doubt ? std::max(doubt, within) : within);
  if (closed > 0)
    pair.closed = closed_in_words(pair.section, pair.called, closed, all.least, all.largest);
  else if (is_in_doubt)
    pair.closed = pair.section + ": " + pair.called[0] + " and " + pair.called[1] + " lie up to " +
                  to_string(-all.least) + " inside each other, at " + to_string(all.at_least) +
                  ", less than circles through their nodes leave open, " + to_string(doubt) +
                  (touches ? ": that counts as touching" : ": that depth counts as none");
  for (const unsigned int k : {0, 1})
  {
    std::vector<bool> is_in_pair(sides[k].all.size(), false);
    for (unsigned int f = 0; f < sides[k].number.size(); ++f)
      is_in_pair[sides[k].number[f]] = pair.slave == 1 - k
                                           ? curved->facing[1 - k].is_seen[f]
                                           : curved->facing[k].faces[f].is_covered();
    pair.where[k] =
        expression<3>([faces = CurvedFaces(sides[k].curves), is_in_pair](const Point<3> &x)
                      { return is_in_pair[faces.nearest(x)] ? 1. : -1.; });
    if (!touches)
      pair.distance[k] = beyond<3>(closed, is_in_doubt ? -all.least : 0.,
                                   distance_between(curved->faces[k], curved->faces[1 - k], size));
  }
}
} // namespace

SpacePair read_space_pair(const Parameters &parameters, const std::string &section,
                          const std::string &name, const UserNames &names,
                          std::vector<Scene<3>> &singles)
{
  const std::array<std::string, 2> sides = read_between(parameters, section);
  SpacePair pair{name, section, {}, {}, {}, {}, {}, {}, std::nullopt};
  for (const unsigned int k : {0, 1})
  {
    const SpaceSide side = side_in_space(parameters, section, sides[k], names, singles);
    pair.bodies[k] = side.body;
    pair.sides[k] = side.side;
    pair.called[k] = sides[k];
    pair.part[k] = side.where;
  }
  pair.slave = read_slave(parameters, section, sides, pair.bodies[0] == pair.bodies[1]);
  for (const unsigned int k : {0, 1})
    if (Scene<3> &body = singles[pair.bodies[k]]; body.geometry.shape == Shape::box)
      cut_box(body, pair.sides[k], faces_of(pair, 1 - k, singles).named, section + "/Between");
  return pair;
}

void match_faces(const Parameters &parameters, const std::vector<Scene<3>> &singles,
                 SpacePair &pair)
{
  const double size = std::max(singles[pair.bodies[0]].geometry.diameter(),
                               singles[pair.bodies[1]].geometry.diameter()),
               hair = same_place * size;
  const std::array<SideFaces, 2> sides{{faces_of(pair, 0, singles), faces_of(pair, 1, singles)}};
  if (sides[0].is_curved || sides[1].is_curved)
    return match_curved_faces(parameters, sides, size,
                              std::min(singles[pair.bodies[0]].geometry.diameter(),
                                       singles[pair.bodies[1]].geometry.diameter()),
                              pair);
  const std::array<SidesFacing, 2> facing{{facing_faces(sides[0].named, sides[1].named, hair),
                                           facing_faces(sides[1].named, sides[0].named, hair)}};
  if (!facing[0].any() || !facing[1].any())
    reject_beside(parameters, pair.section, facing[0].look_at_each_other);
  for (const SidesFacing &one : facing)
    if (one.step)
      parameters.reject(pair.section, "Between",
                        "names sides of which one has a step or an edge opposite to a face of the "
                        "other, at " +
                            to_string(*one.step) +
                            "; give the other one an edge there, or name parts of sides");
  const double closed = read_closed_within(parameters, pair.section, size), least = facing[0].least,
               within = std::max(closed, hair);
  if (closed > 0)
    pair.closed = closed_in_words(pair.section, pair.called, closed, least, facing[0].largest);
  if (least < -within)
    reject_overlap(parameters, pair.section, -least, " at " + to_string(facing[0].at_least));
  choose_slave(parameters, pair.section, {{!facing[0].are_covered(), !facing[1].are_covered()}},
               pair.slave);
  for (const unsigned int k : {0, 1})
    place_pair(pair, k, sides[k], facing[k], closed, facing[0].largest <= within);
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
    part.gap = read.distance[k];
    scene.boundaries.push_back(part);
  }
  scene.pairs.push_back(pair);
}
} // namespace hpvi
