// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/contact_order.h>
#include <hpvi/plane/curved_edges.h>

#include <algorithm>
#include <map>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * The edges of one boundary, ascending, as they follow each other. The mesh begins its loops anywhere: what ends where a chain of
 * edges begins comes before it, so that a chain begins at an end of the boundary.
 */
std::vector<unsigned int> chained(const CoarseMesh &mesh, std::vector<unsigned int> edges)
{
  const auto meet = [&](const unsigned int one, const unsigned int other)
  { return mesh.edges[one].vertices[1] == mesh.edges[other].vertices[0]; };
  for (auto begin = edges.begin(); begin != edges.end();)
  {
    auto end = begin + 1;
    while (end != edges.end() && meet(end[-1], *end))
      ++end;
    const auto last =
        std::find_if(end, edges.end(), [&](const unsigned int edge) { return meet(edge, *begin); });
    if (last != edges.end())
    {
      auto first = last;
      while (first != end && meet(first[-1], *first))
        --first;
      std::rotate(begin, first, last + 1);
      end += last + 1 - first;
    }
    begin = end;
  }
  return edges;
}
} // namespace

template <int dim>
void sort_along_boundaries(const Geometry<dim> &geometry, std::vector<ContactFace<dim>> &faces)
{
  if (!geometry.mesh)
    return std::stable_sort(faces.begin(), faces.end(),
                            [](const ContactFace<dim> &a, const ContactFace<dim> &b)
                            {
                              if (a.condition->id != b.condition->id)
                                return a.condition->id < b.condition->id;
                              return a.frame(0.5).tangent * (b.point(0.5) - a.point(0.5)) > 0;
                            });
  const EdgePlaces places(*geometry.mesh);
  std::vector<EdgePlace> at;
  std::map<types::boundary_id, std::vector<unsigned int>> edges;
  for (const ContactFace<dim> &face : faces)
  {
    at.push_back(places(face.cell, face.face_no));
    edges[face.condition->id].push_back(at.back().edge);
  }
  std::map<unsigned int, unsigned int> ranks;
  for (auto &[boundary, own] : edges)
  {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (const unsigned int edge : chained(*geometry.mesh, own))
      ranks.emplace(edge, ranks.size());
  }
  std::vector<std::pair<double, unsigned int>> order;
  for (unsigned int k = 0; k < faces.size(); ++k)
    order.emplace_back(ranks.at(at[k].edge) + (at[k].from + at[k].to) / 2, k);
  std::sort(order.begin(), order.end());
  std::vector<ContactFace<dim>> sorted;
  for (const auto &[place, k] : order)
    sorted.push_back(faces[k]);
  faces = std::move(sorted);
}

template void sort_along_boundaries(const Geometry<2> &, std::vector<ContactFace<2>> &);
} // namespace hpvi
