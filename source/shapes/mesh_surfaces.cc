// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/shapes/mesh_surfaces.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
using Ends = std::array<unsigned int, 2>;

/** The cell that has each edge counterclockwise. */
std::map<Ends, unsigned int> cells_by_edge(const CoarseMesh &mesh)
{
  std::map<Ends, unsigned int> result;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    for (unsigned int v = 0; v < 4; ++v)
      result[{{mesh.cells[c].vertices[v], mesh.cells[c].vertices[(v + 1) % 4]}}] = c;
  return result;
}

/** Adds @p name to @p names unless it is there; its number. */
unsigned int number_of(const std::string &name, std::vector<std::string> &names)
{
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end())
    return found - names.begin();
  names.push_back(name);
  return names.size() - 1;
}

/** Edges along the boundary one after the other, each where the one before ends. */
void follow(std::vector<CoarseMesh::Edge> &edges)
{
  for (std::size_t k = 1; k < edges.size(); ++k)
    for (std::size_t next = k; next < edges.size(); ++next)
      if (edges[next].vertices[0] == edges[k - 1].vertices[1])
      {
        std::rotate(edges.begin() + k, edges.begin() + next, edges.begin() + next + 1);
        break;
      }
}
} // namespace

CoarseMesh surfaces_of(const CoarseMesh &mesh, const std::vector<std::string> &surfaces)
{
  const auto is_wanted = [&](const unsigned int cell)
  {
    return surfaces.empty() || std::find(surfaces.begin(), surfaces.end(),
                                         mesh.surfaces[mesh.cells[cell].surface]) != surfaces.end();
  };
  CoarseMesh result;
  result.surfaces = mesh.surfaces;
  std::map<unsigned int, unsigned int> vertices;
  const auto vertex = [&](const unsigned int v)
  {
    const auto [known, is_new] = vertices.emplace(v, result.vertices.size());
    if (is_new)
      result.vertices.push_back(mesh.vertices[v]);
    return known->second;
  };
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    if (is_wanted(c))
    {
      result.cells.push_back(mesh.cells[c]);
      for (unsigned int &v : result.cells.back().vertices)
        v = vertex(v);
    }

  const std::map<Ends, unsigned int> cells = cells_by_edge(mesh);
  std::map<Ends, const CoarseMesh::Edge *> known;
  for (const CoarseMesh::Edge &edge : mesh.edges)
    known[edge.vertices] = known[{{edge.vertices[1], edge.vertices[0]}}] = &edge;
  std::vector<CoarseMesh::Edge> inside;
  for (const auto &[ends, cell] : cells)
  {
    const auto other = cells.find({{ends[1], ends[0]}});
    const bool is_inside = other != cells.end() && is_wanted(other->second);
    const auto found = known.find(ends);
    if (!is_wanted(cell) || (is_inside && (found == known.end() || ends[0] > ends[1])))
      continue;
    CoarseMesh::Edge edge;
    std::string name;
    if (found != known.end())
    {
      const CoarseMesh::Edge &drawn = *found->second;
      edge.curve = drawn.vertices == ends || !drawn.curve ? drawn.curve : drawn.curve.between(1, 0);
      name = drawn.boundary != CoarseMesh::inside    ? mesh.boundaries[drawn.boundary]
             : drawn.interface != CoarseMesh::inside ? mesh.interfaces[drawn.interface]
                                                     : "";
    }
    edge.vertices = {{vertex(ends[0]), vertex(ends[1])}};
    if (is_inside)
    {
      if (!name.empty())
        edge.interface = number_of(name, result.interfaces);
      inside.push_back(edge);
    }
    else
    {
      edge.boundary = number_of(name, result.boundaries);
      result.edges.push_back(edge);
    }
  }
  // Edges without a name come last.
  const auto nameless = std::find(result.boundaries.begin(), result.boundaries.end(), "");
  if (nameless != result.boundaries.end() && nameless != result.boundaries.end() - 1)
  {
    const unsigned int from = nameless - result.boundaries.begin(),
                       last = result.boundaries.size() - 1;
    std::swap(result.boundaries[from], result.boundaries[last]);
    for (CoarseMesh::Edge &edge : result.edges)
      edge.boundary = edge.boundary == from ? last : edge.boundary == last ? from : edge.boundary;
  }
  follow(result.edges);
  result.edges.insert(result.edges.end(), inside.begin(), inside.end());
  return result;
}

unsigned int n_parts(const CoarseMesh &mesh)
{
  std::vector<unsigned int> parent(mesh.cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](unsigned int c)
  {
    while (parent[c] != c)
      c = parent[c] = parent[parent[c]];
    return c;
  };
  unsigned int n = mesh.cells.size();
  const std::map<Ends, unsigned int> cells = cells_by_edge(mesh);
  for (const auto &[ends, cell] : cells)
    if (const auto other = cells.find({{ends[1], ends[0]}});
        other != cells.end() && root(cell) != root(other->second))
    {
      parent[root(cell)] = root(other->second);
      --n;
    }
  return n;
}
} // namespace hpvi
