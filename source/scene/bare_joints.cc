// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/scene/bare_joints.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/contact_search.h>
#include <hpvi/scene/curved_facing.h>
#include <hpvi/scene/exact_side.h>
#include <hpvi/scene/faces_across.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{

struct FreeSide
{
  std::string name;
  unsigned int body;
  bool is_held;
  ExactSide drawn;
};

template <int dim>
std::string called(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary)
{
  return boundary.name.empty()
             ? "a side of " +
                   scene.geometry.bodies[scene.geometry.body_of_side(boundary.side)].name +
                   " without a name"
             : boundary.name;
}

std::vector<FreeSide> sides_without_pair(const Scene<2> &scene)
{
  const std::vector<Side<2>> sides = sides_of(scene);
  std::vector<FreeSide> result;
  for (const BoundaryCondition<2> &boundary : scene.boundaries)
  {
    const Side<2> &side = sides[boundary.id];
    if (boundary.pair || side.pieces.empty())
      continue;
    std::vector<EdgePath> edges;
    for (unsigned int k = 0; k < side.pieces.size(); ++k)
      edges.push_back({side.pieces[k], side.curves[k]});
    const unsigned int body = scene.geometry.body_of_side(boundary.side);
    result.push_back({called(scene, boundary), body,
                      boundary.has_displacement() || boundary.symmetry || boundary.plate,
                      ExactSide(edges)});
  }
  return result;
}

/**
 * A place in the middle of an edge of @p one, or near its ends, from which the other side is no distance away along the normal, and
 * beside it, too. Where edges have a part in common there is an end of one of them.
 */
std::optional<Point<2>> common_place(const ExactSide &one, const ExactSide &other,
                                     const double within)
{
  const auto touches = [&](const EdgePath &edge, const double s)
  {
    const auto there = other.opposite(edge.point(s), edge.normal(s));
    return there && std::abs(there->place.distance) <= within;
  };
  for (const EdgePath &edge : one.edges())
    for (const double s : {0.5, 0.001, 0.999})
      if (touches(edge, s) && touches(edge, s < 0.5 ? s + 0.01 : s - 0.01))
        return edge.point(s);
  return std::nullopt;
}

/** An end of an edge of @p one at which the other side is no distance away, and beside which it goes on opposite to the edge. */
std::optional<Point<2>> common_point(const ExactSide &one, const ExactSide &other,
                                     const double within)
{
  const auto distance = [&](const EdgePath &edge, const double s)
  {
    const auto there = other.opposite(edge.point(s), edge.normal(s));
    return there ? std::abs(there->place.distance) : 1e300;
  };
  for (const EdgePath &edge : one.edges())
    for (const double s : {0., 1.})
      if (distance(edge, s) <= within && distance(edge, s < 0.5 ? 0.01 : 0.99) <=
                                             within + 1e-3 * edge.point(0).distance(edge.point(1)))
        return edge.point(s);
  return std::nullopt;
}

using FindPlace = std::optional<Point<2>> (*)(const ExactSide &, const ExactSide &, double);

std::optional<Point<2>> place_of_both(const FindPlace find, const FreeSide &one,
                                      const FreeSide &other, const double within)
{
  const auto at = find(one.drawn, other.drawn, within);
  return at ? at : find(other.drawn, one.drawn, within);
}
} // namespace

std::vector<BareJoint<2>> bare_joints(const Scene<2> &scene)
{
  std::vector<BareJoint<2>> result;
  if (scene.geometry.bodies.empty())
    return result;
  const double size = scene.geometry.diameter();
  const std::vector<FreeSide> sides = sides_without_pair(scene);
  for (const FreeSide &one : sides)
    for (const FreeSide &other : sides)
    {
      if (one.body >= other.body || (one.is_held && other.is_held))
        continue;
      if (const auto at = place_of_both(common_place, one, other, same_place * size))
        result.push_back({{{one.name, other.name}}, *at});
    }
  return result;
}

std::vector<BareJoint<2>> touching_sides(const Scene<2> &scene, const double within)
{
  std::vector<BareJoint<2>> result;
  const double near = std::max(within, same_place * scene.geometry.diameter());
  const std::vector<FreeSide> sides = sides_without_pair(scene);
  for (const FreeSide &one : sides)
    for (const FreeSide &other : sides)
      if (one.body < other.body)
        for (const FindPlace find : {common_place, common_point})
          if (const auto at = place_of_both(find, one, other, near))
          {
            result.push_back({{{one.name, other.name}}, *at});
            break;
          }
  return result;
}

namespace
{
bool is_curved(const Side<3> &side)
{
  return std::any_of(side.curves.begin(), side.curves.end(),
                     [](const CurvedFace &curve) { return bool(curve); });
}

BoundingBox<3> box_around(const Side<3> &side)
{
  BoundingBox<3> result = side.box(0);
  for (unsigned int k = 1; k < side.pieces.size(); ++k)
    result.merge_with(side.box(k));
  return result;
}

CurvedFaces curves_of(const Side<3> &side)
{
  std::vector<CurvedFace> result;
  for (unsigned int k = 0; k < side.pieces.size(); ++k)
    result.push_back(side.curve(k) ? side.curve(k) : flat_face(side.pieces[k]));
  return CurvedFaces(std::move(result));
}

/** Where one is nearest to the other along its normals; nothing: they are farther apart than @p near, or do not look at each other. */
std::optional<Point<3>> touching_place(const Side<3> &one, const Side<3> &other, const double near,
                                       const double hair)
{
  if (!is_curved(one) && !is_curved(other))
  {
    const SidesFacing facing = facing_faces(one.pieces, other.pieces, hair);
    return facing.any() && std::abs(facing.least) <= near ? std::optional(facing.at_least)
                                                          : std::nullopt;
  }
  BoundingBox<3> box = box_around(one);
  box.extend(near);
  if (box.get_neighbor_type(box_around(other)) == NeighborType::not_neighbors)
    return std::nullopt;
  const CurvedFacing facing(curves_of(one), curves_of(other));
  const auto nearest = std::min_element(facing.faces.begin(), facing.faces.end(),
                                        [](const CurvedFacing::Face &a, const CurvedFacing::Face &b)
                                        { return a.least < b.least; });
  return facing.any() && std::abs(nearest->least) <= near ? std::optional(nearest->at_least)
                                                          : std::nullopt;
}
} // namespace

std::vector<BareJoint<3>> touching_sides(const Scene<3> &scene, const double within)
{
  std::vector<BareJoint<3>> result;
  const double hair = same_place * scene.geometry.diameter(), near = std::max(within, hair);
  const std::vector<Side<3>> sides = sides_of(scene);
  for (const BoundaryCondition<3> &one : scene.boundaries)
    for (const BoundaryCondition<3> &other : scene.boundaries)
    {
      if (one.pair || other.pair || sides[one.id].pieces.empty() ||
          sides[other.id].pieces.empty() ||
          scene.geometry.body_of_side(one.side) >= scene.geometry.body_of_side(other.side))
        continue;
      if (const auto at = touching_place(sides[one.id], sides[other.id], near, hair))
        result.push_back({{{called(scene, one), called(scene, other)}}, *at});
    }
  return result;
}
} // namespace hpvi
