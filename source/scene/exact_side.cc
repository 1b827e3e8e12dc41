// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/exact_side.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace hpvi
{
using namespace dealii;

namespace
{
std::vector<EdgePath> paths_of(const Geometry<2> &geometry, const unsigned int side,
                               const Expression<2> &where)
{
  std::vector<EdgePath> result;
  for (const CoarseFace<2> &face : coarse_faces(geometry, side))
  {
    if (where && where->value(middle_of(face)) <= 0)
      continue;
    const EdgePath path{{{face.corners[0], face.corners[1]}}, face.curve};
    const bool runs_round = path.normal(0.5) * (path.point(0.5) - face.inside) > 0;
    result.push_back(runs_round ? path : path.reversed());
  }
  return result;
}

std::vector<BoundingBox<2>> boxes_around(const std::vector<EdgePath> &paths)
{
  std::vector<BoundingBox<2>> result;
  for (const EdgePath &path : paths)
    result.push_back(box_around(path));
  return result;
}
} // namespace

ExactSide::ExactSide(const Geometry<2> &geometry, const unsigned int side,
                     const Expression<2> &where)
    : ExactSide(paths_of(geometry, side, where))
{
}

ExactSide::ExactSide(const std::vector<EdgePath> &edges) : paths(edges), tree(boxes_around(edges))
{
}

const std::vector<EdgePath> &ExactSide::edges() const
{
  return paths;
}

unsigned int ExactSide::nearest_edge(const Point<2> &x) const
{
  return tree.nearest(x, [&](const unsigned int e)
                      { return paths[e].point(paths[e].nearest(x)).distance(x); });
}

std::optional<ExactSide::Place> ExactSide::opposite(const Point<2> &x, const Tensor<1, 2> &n) const
{
  std::optional<Place> result;
  for (const unsigned int e : tree.along(x, n))
    if (const auto place = place_opposite(paths[e], x, n);
        place && (!result || std::abs(place->distance) < std::abs(result->place.distance)))
      result = Place{e, *place};
  return result;
}

Expression<2> distance_along_normal(const ExactSide &own, const ExactSide &other)
{
  return expression<2>(std::function<double(const Point<2> &)>(
      [own, other](const Point<2> &x)
      {
        const EdgePath &edge = own.edges()[own.nearest_edge(x)];
        const double s = edge.nearest(x);
        const Point<2> from = edge.point(s);
        if (const auto there = other.opposite(from, edge.normal(s)))
          return there->place.distance;
        const EdgePath &nearest = other.edges()[other.nearest_edge(from)];
        return nearest.point(nearest.nearest(from)).distance(from);
      }));
}
} // namespace hpvi
