// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/cell_edges.h>

#include <algorithm>

namespace hpvi
{
namespace
{
std::pair<unsigned int, unsigned int> key(const std::array<unsigned int, 2> &vertices)
{
  return std::minmax(vertices[0], vertices[1]);
}

/** Its corners from the smallest: the same for a cell that is there twice. */
std::array<unsigned int, 4> sorted(std::array<unsigned int, 4> vertices)
{
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}
} // namespace

std::string edge_in_words(const CoarseMesh &mesh, const std::array<unsigned int, 2> &vertices)
{
  return "from " + to_string(mesh.vertices[vertices[0]]) + " to " +
         to_string(mesh.vertices[vertices[1]]);
}

CellEdges::CellEdges(const CoarseMesh &mesh, const std::vector<std::size_t> &numbers_in_file,
                     const MeshComplaint &complain)
    : mesh(mesh), numbers_in_file(numbers_in_file), complain(complain)
{
  std::vector<CellEdge> sides;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    for (unsigned int k = 0; k < 4; ++k)
    {
      const auto &v = mesh.cells[c].vertices;
      sides.push_back({{{v[k], v[(k + 1) % 4]}}, {{c, CoarseMesh::inside}}});
    }
  std::sort(sides.begin(), sides.end(),
            [](const CellEdge &one, const CellEdge &two) {
              return std::pair(key(one.vertices), one.cells) <
                     std::pair(key(two.vertices), two.cells);
            });
  for (const CellEdge &side : sides)
    if (edges.empty() || key(edges.back().vertices) != key(side.vertices))
      edges.push_back(side);
    else
    {
      check_pair(edges.back(), side);
      edges.back().cells[1] = side.cells[0];
    }
  find_loops();
}

void CellEdges::check_pair(const CellEdge &one, const CellEdge &two) const
{
  const unsigned int first = one.cells[0], second = two.cells[0];
  const std::string where = edge_in_words(mesh, one.vertices);
  if (sorted(mesh.cells[first].vertices) == sorted(mesh.cells[second].vertices))
  {
    complain.of(numbers_in_file[second], "the cell with the edge " + where + " is there already" +
                                             as_element(first) + "; write the file anew");
  }
  if (!one.is_on_boundary())
    complain.of(numbers_in_file[second],
                "three cells have the edge " + where +
                    "; remove the surface that overlaps others from the drawing");
  if (one.vertices == two.vertices)
    complain.of(numbers_in_file[second],
                "two cells lie on the same side of the edge " + where + as_element(first) +
                    ": the mesh is folded, or surfaces overlap; mesh it with another "
                    "Mesh.RecombinationAlgorithm and Mesh.SubdivisionAlgorithm = 0, or remove one "
                    "of the surfaces");
}

std::string CellEdges::as_element(const unsigned int cell) const
{
  return numbers_in_file[cell] == 0
             ? ""
             : ", the other is element " + std::to_string(numbers_in_file[cell]);
}

const std::vector<CellEdge> &CellEdges::all() const
{
  return edges;
}

unsigned int CellEdges::find(const unsigned int vertex, const unsigned int other) const
{
  const auto wanted = std::pair(std::min(vertex, other), std::max(vertex, other));
  const auto found = std::lower_bound(edges.begin(), edges.end(), wanted,
                                      [](const CellEdge &edge, const auto &pair)
                                      { return key(edge.vertices) < pair; });
  return found == edges.end() || key(found->vertices) != wanted ? CoarseMesh::inside
                                                                : found - edges.begin();
}

void CellEdges::find_loops()
{
  std::vector<unsigned int> next(mesh.vertices.size(), CoarseMesh::inside);
  for (unsigned int e = 0; e < edges.size(); ++e)
    if (edges[e].is_on_boundary())
    {
      unsigned int &edge = next[edges[e].vertices[0]];
      if (edge != CoarseMesh::inside)
        complain("cells touch each other at the point " +
                 to_string(mesh.vertices[edges[e].vertices[0]]) +
                 " alone, which is no joint; let them share an edge, or part them");
      edge = e;
    }
  for (unsigned int vertex = 0; vertex < next.size(); ++vertex)
    for (unsigned int v = vertex; next[v] != CoarseMesh::inside;)
    {
      const unsigned int edge = std::exchange(next[v], CoarseMesh::inside);
      boundary.push_back(edge);
      v = edges[edge].vertices[1];
    }
}

const std::vector<unsigned int> &CellEdges::loops() const
{
  return boundary;
}
} // namespace hpvi
