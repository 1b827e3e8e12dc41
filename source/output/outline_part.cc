// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/cell_outline.h>
#include <hpvi/output/outline_part.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
/** From vertex to vertex, the body on the left. */
struct Edge
{
  unsigned int from, to;
  types::boundary_id boundary;
  Tensor<1, 2> leaving, arriving; ///< along it at its ends, of length 1
  std::vector<Point<2>> line;     ///< its ends and what is curved between them
};

std::vector<Edge> boundary_edges(const Triangulation<2> &mesh)
{
  std::vector<Edge> edges;
  for (const auto &cell : mesh.active_cell_iterators())
    for (const unsigned int number : cell->face_indices())
      if (cell->at_boundary(number))
      {
        const auto face = cell->face(number);
        const Tensor<1, 2> way = face->vertex(1) - face->vertex(0);
        const Tensor<1, 2> inward = cell->center() - face->center();
        unsigned int from = face->vertex_index(0), to = face->vertex_index(1);
        std::vector<Point<2>> line = face_line(map_of<2>(cell), number);
        if (way[0] * inward[1] - way[1] * inward[0] < 0)
        {
          std::swap(from, to);
          line = {line.rbegin(), line.rend()};
        }
        const Tensor<1, 2> first = line[1] - line[0], last = *(line.end() - 1) - *(line.end() - 2);
        edges.push_back(
            {from, to, face->boundary_id(), first / first.norm(), last / last.norm(), line});
      }
  return edges;
}

/** Does @p next go on where @p edge ends, and without a corner? */
bool continues(const Edge &edge, const Edge &next)
{
  constexpr double cosine_of_corner =
      0.64; // 50 degrees: an edge of a polygon for a curve turns by less
  return next.boundary == edge.boundary && edge.arriving * next.leaving > cosine_of_corner;
}
} // namespace

OutlinePart::OutlinePart(const types::boundary_id boundary, const std::vector<Point<2>> &points)
    : boundary(boundary), vertices(points), distances{0.}
{
  for (std::size_t k = 1; k < points.size(); ++k)
    distances.push_back(distances.back() + points[k].distance(points[k - 1]));
}

double OutlinePart::length() const
{
  return distances.back();
}

const std::vector<Point<2>> &OutlinePart::points() const
{
  return vertices;
}

OutlinePlace OutlinePart::at(const double distance) const
{
  const auto after = std::upper_bound(distances.begin() + 1, distances.end() - 1, distance);
  const std::size_t k = after - distances.begin();
  const Tensor<1, 2> way = vertices[k] - vertices[k - 1];
  const double share = (distance - distances[k - 1]) / (distances[k] - distances[k - 1]);
  Tensor<1, 2> normal({way[1], -way[0]});
  // the ends exactly: there an expression may jump
  const Point<2> x = share <= 0   ? vertices[k - 1]
                     : share >= 1 ? vertices[k]
                                  : vertices[k - 1] + share * way;
  return {x, normal / normal.norm()};
}

std::vector<OutlinePart> boundary_parts(const Triangulation<2> &mesh)
{
  const std::vector<Edge> edges = boundary_edges(mesh);
  std::multimap<unsigned int, const Edge *> starting, ending;
  for (const Edge &edge : edges)
  {
    starting.emplace(edge.from, &edge);
    ending.emplace(edge.to, &edge);
  }
  std::set<const Edge *> done;
  const auto neighbour = [&](const Edge &edge, const bool is_next) -> const Edge *
  {
    const auto &map = is_next ? starting : ending;
    const auto [first, last] = map.equal_range(is_next ? edge.to : edge.from);
    for (auto other = first; other != last; ++other)
      if (is_next ? continues(edge, *other->second) : continues(*other->second, edge))
        return other->second;
    return nullptr;
  };
  std::vector<OutlinePart> parts;
  for (const Edge &edge : edges)
  {
    if (done.count(&edge))
      continue;
    const Edge *first = &edge; // of a closed curve any
    std::set<const Edge *> passed;
    for (const Edge *before = first; before && !done.count(before) && passed.insert(before).second;
         before = neighbour(*before, false))
      first = before;
    std::vector<Point<2>> points{mesh.get_vertices()[first->from]};
    for (const Edge *next = first; next && done.insert(next).second; next = neighbour(*next, true))
      points.insert(points.end(), next->line.begin() + 1, next->line.end());
    parts.emplace_back(edge.boundary, points);
  }
  return parts;
}
} // namespace hpvi
