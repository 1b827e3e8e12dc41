// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/drawn_side.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace hpvi
{
using namespace dealii;

DrawnSide::DrawnSide(const Geometry<2> &geometry, const unsigned int side)
{
  for (const CoarseFace<2> &face : coarse_faces(geometry, side))
  {
    const EdgePath path{{{face.corners[0], face.corners[1]}}, face.curve};
    const bool runs_round = path.normal(0.5) * (path.point(0.5) - face.inside) > 0;
    paths.push_back(runs_round ? path : path.reversed());
    Disc disc{path.point(0.5), 0};
    for (unsigned int k = 0; k <= 8; ++k)
      disc.radius = std::max(disc.radius, 1.01 * disc.centre.distance(path.point(k / 8.)));
    discs.push_back(disc);
  }
}

const std::vector<EdgePath> &DrawnSide::edges() const
{
  return paths;
}

unsigned int DrawnSide::nearest_edge(const Point<2> &x) const
{
  double enough = std::numeric_limits<double>::max(); // centres of discs lie on their edges
  for (const Disc &disc : discs)
    enough = std::min(enough, disc.centre.distance(x));
  unsigned int result = 0;
  double least = std::numeric_limits<double>::max();
  for (unsigned int e = 0; e < paths.size(); ++e)
  {
    if (discs[e].centre.distance(x) - discs[e].radius > std::min(enough, least))
      continue;
    if (const double here = paths[e].point(paths[e].nearest(x)).distance(x); here < least)
    {
      least = here;
      result = e;
    }
  }
  return result;
}

std::optional<DrawnSide::Place> DrawnSide::opposite(const Point<2> &x, const Tensor<1, 2> &n) const
{
  const Tensor<1, 2> across = cross_product_2d(n);
  std::optional<Place> result;
  for (unsigned int e = 0; e < paths.size(); ++e)
    if (std::abs((discs[e].centre - x) * across) <= discs[e].radius)
      if (const auto place = place_opposite(paths[e], x, n);
          place && (!result || std::abs(place->distance) < std::abs(result->place.distance)))
        result = Place{e, *place};
  return result;
}

Expression<2> distance_along_normal(const DrawnSide &own, const DrawnSide &other)
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
