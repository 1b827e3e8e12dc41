// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/bent_lines.h>
#include <hpvi/reader/gmsh/cell_checks.h>
#include <hpvi/reader/gmsh/curve_numbers.h>
#include <hpvi/reader/gmsh/element_checks.h>
#include <hpvi/reader/gmsh/gmsh_file.h>
#include <hpvi/reader/gmsh/mesh_file.h>
#include <hpvi/reader/gmsh/mesh_groups.h>
#include <hpvi/reader/gmsh/polynomial_edge.h>
#include <hpvi/reader/gmsh/quadratic_edge.h>
#include <hpvi/reader/gmsh/quadrilaterals.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
class MeshMaker
{
public:
  MeshMaker(const GmshFile &file, const std::vector<std::string> &surfaces,
            const DrawingRequest &request, const MeshComplaint &complain)
      : file(file), wanted(surfaces), request(request), complain(complain),
        vertex_of(file.nodes.size(), CoarseMesh::inside)
  {
  }

  CoarseMesh make()
  {
    take_cells();
    if (mesh.cells.empty())
      return std::move(mesh);
    take_vertices();
    orient_cells(mesh, numbers_of_cells, complain);
    const CellEdges edges(mesh, numbers_of_cells, complain);
    check_connection(mesh, edges, complain);
    take_middles(edges);
    take_edges(edges, edge_groups(edges));
    mesh.origin = file.origin;
    mesh.is_numbered = file.is_numbered;
    mesh.remarks = file.remarks;
    return std::move(mesh);
  }

private:
  static bool is_cell(const GmshFile::Element &element)
  {
    return element_kind(element.type).dim == 2;
  }

  /** All surfaces have numbers, those too that are left out. */
  void take_cells()
  {
    std::vector<std::int64_t> tags;
    for (const GmshFile::Element &element : file.elements)
      if (is_cell(element))
        tags.push_back(element.group);
    const GroupNumbers numbers(file, 2, tags, complain);
    mesh.surfaces = numbers.names();
    for (const GmshFile::Element &element : file.elements)
      if (is_cell(element) && !is_wanted(numbers.number(element.group)))
        leave_out(element);
      else if (is_cell(element))
      {
        CoarseMesh::Cell cell;
        cell.surface = numbers.number(element.group);
        for (unsigned int k = 0; k < 4; ++k)
          cell.vertices[k] = take_node(element.nodes[k], element.number);
        for (unsigned int k = 0; k < 4; ++k)
          if (std::count(cell.vertices.begin(), cell.vertices.end(), cell.vertices[k]) > 1)
            complain.of(element.number, "the cell has the node " +
                                            std::to_string(file.nodes[element.nodes[k]].tag) +
                                            " twice; write the file anew");
        mesh.cells.push_back(cell);
        numbers_of_cells.push_back(element.number);
      }
  }

  bool is_wanted(const unsigned int surface) const
  {
    return wanted.empty() ||
           std::find(wanted.begin(), wanted.end(), mesh.surfaces[surface]) != wanted.end();
  }

  void leave_out(const GmshFile::Element &cell)
  {
    for (unsigned int k = 0; k < 4; ++k)
      left_out.insert(std::minmax({cell.nodes[k], cell.nodes[(k + 1) % 4]}));
  }

  /** Is it of no cell of the file? Those of cells that are left out are left out with them. */
  bool is_loose(const CellEdges &edges, const GmshFile::Element &line) const
  {
    return edge_between(edges, line.nodes[0], line.nodes[1]) == CoarseMesh::inside &&
           left_out.count(std::minmax({line.nodes[0], line.nodes[1]})) == 0;
  }

  unsigned int take_node(const unsigned int node, const std::size_t element)
  {
    if (vertex_of[node] == CoarseMesh::inside)
    {
      vertex_of[node] = nodes.size();
      nodes.push_back(node);
      mesh.vertices.push_back(plane_point(node, element));
    }
    return vertex_of[node];
  }

  /** In which z is 0 to round-off: it is measured when the size is known. */
  Point<2> plane_point(const unsigned int node, const std::size_t element)
  {
    const Point<3> &at = file.nodes[node].at;
    if (std::abs(at[2]) > largest_z)
    {
      largest_z = std::abs(at[2]);
      highest = node;
      element_of_highest = element;
    }
    return Point<2>(at[0], at[1]);
  }

  void take_vertices()
  {
    size = size_of(mesh, complain);
    check_plane();
    check_places(file, mesh, nodes, size, complain);
  }

  void check_plane() const
  {
    if (largest_z <= 1e-12 * size)
      return;
    const Point<3> &at = file.nodes[highest].at;
    complain.of(element_of_highest,
                "the node " + std::to_string(file.nodes[highest].tag) + " at " + to_string(at) +
                    " is not in the plane z = 0, in which a body lies; draw it there");
  }

  /** Of edges, from cells and lines of second order. */
  void take_middles(const CellEdges &edges)
  {
    middles.assign(edges.all().size(), CoarseMesh::inside);
    for (const GmshFile::Element &element : file.elements)
    {
      const ElementKind kind = element_kind(element.type);
      if (kind.n_nodes == kind.n_corners)
        continue;
      for (unsigned int k = 0; k < (kind.dim == 1 ? 1 : 4); ++k)
      {
        const unsigned int e =
            edge_between(edges, element.nodes[k], element.nodes[(k + 1) % kind.n_corners]);
        if (e == CoarseMesh::inside)
          continue; // a line that edge_groups() refuses, or one in no group, or what is left out
        const unsigned int middle = element.nodes[kind.n_corners + k];
        if (middles[e] != CoarseMesh::inside && middles[e] != middle)
          complain.of(element.number, "the edge " + edge_in_words(mesh, edges.all()[e].vertices) +
                                          " has a second node in its middle; write the file anew");
        middles[e] = middle;
      }
    }
  }

  unsigned int edge_between(const CellEdges &edges, const unsigned int node,
                            const unsigned int other) const
  {
    const unsigned int v = vertex_of[node], w = vertex_of[other];
    return v == CoarseMesh::inside || w == CoarseMesh::inside ? CoarseMesh::inside
                                                              : edges.find(v, w);
  }

  /** The tag of the physical curve on each edge; 0: none. */
  std::vector<std::int64_t> edge_groups(const CellEdges &edges) const
  {
    if (std::all_of(file.elements.begin(), file.elements.end(), is_cell))
      return numbered_edges(edges);
    std::vector<std::int64_t> groups(edges.all().size(), 0);
    for (const GmshFile::Element &element : file.elements)
    {
      if (is_cell(element) || element.group == 0)
        continue;
      if (is_loose(edges, element) && !file.is_numbered)
        refuse_loose_lines(edges, element);
      const unsigned int e = edge_between(edges, element.nodes[0], element.nodes[1]);
      if (e != CoarseMesh::inside)
        groups[e] = element.group;
    }
    return groups;
  }

  std::vector<std::int64_t> numbered_edges(const CellEdges &edges) const
  {
    std::vector<CurvePiece> curves;
    for (unsigned int e = 0; e < edges.all().size(); ++e)
      curves.push_back(curved_edge(edges.all()[e].vertices, middles[e]).curve);
    return groups_between_corners(mesh, edges, curves, request, complain);
  }

  [[noreturn]] void refuse_loose_lines(const CellEdges &edges, const GmshFile::Element &first) const
  {
    unsigned int n = 0;
    for (const GmshFile::Element &element : file.elements)
      n += !is_cell(element) && element.group == first.group && is_loose(edges, element);
    const auto place = [&](const unsigned int k)
    {
      const Point<3> &at = file.nodes[first.nodes[k]].at;
      return to_string(Point<2>(at[0], at[1]));
    };
    complain.of(first.number, "the physical " + file.words({1, first.group}) + " has " +
                                  std::to_string(n) + (n == 1 ? " edge" : " edges") +
                                  " of no cell, the first from " + place(0) + " to " + place(1) +
                                  "; let it be a curve of a surface, or remove it");
  }

  void take_edges(const CellEdges &edges, const std::vector<std::int64_t> &groups)
  {
    const EdgeGroups numbers(file, mesh, edges, groups, complain);
    mesh.boundaries = numbers.boundaries.names();
    mesh.interfaces = numbers.interfaces.names();
    for (const unsigned int e : numbers.ordered_loops())
    {
      CoarseMesh::Edge edge = curved_edge(edges.all()[e].vertices, middles[e]);
      edge.boundary = numbers.boundaries.number(groups[e]);
      mesh.edges.push_back(edge);
    }
    for (unsigned int e = 0; e < groups.size(); ++e)
      if (!edges.all()[e].is_on_boundary())
        take_inner_edge(edges.all()[e], groups[e], middles[e], numbers.interfaces);
  }

  void take_inner_edge(const CellEdge &shared, const std::int64_t group, const unsigned int middle,
                       const GroupNumbers &interfaces)
  {
    const unsigned int one = mesh.cells[shared.cells[0]].surface,
                       two = mesh.cells[shared.cells[1]].surface;
    if (group == 0 && one == two)
      return;
    auto vertices = shared.vertices;
    if (two < one)
      std::swap(vertices[0], vertices[1]);
    CoarseMesh::Edge edge = curved_edge(vertices, middle);
    if (group != 0)
      edge.interface = interfaces.number(group);
    if (group != 0 || edge.curve)
      mesh.edges.push_back(edge);
  }

  CoarseMesh::Edge curved_edge(const std::array<unsigned int, 2> &vertices,
                               const unsigned int middle) const
  {
    CoarseMesh::Edge edge;
    edge.vertices = vertices;
    edge.curve = file.curve(nodes[vertices[0]], nodes[vertices[1]]);
    if (edge.curve)
      check_curve(edge);
    if (edge.curve || middle == CoarseMesh::inside)
      return edge;
    const GmshFile::Node &node = file.nodes[middle];
    const auto curve = std::make_shared<QuadraticEdge>(
        mesh.vertices[vertices[0]], Point<2>(node.at[0], node.at[1]), mesh.vertices[vertices[1]]);
    const std::string words = "the middle node " + std::to_string(node.tag) + " of the edge " +
                              edge_in_words(mesh, vertices);
    if (std::abs(node.at[2]) > 1e-12 * size)
      complain(words + " is not in the plane z = 0, in which a body lies; draw it there");
    if (!curve->is_regular())
      complain(words + " is not in the middle half of it, where the curve would turn back; mesh "
                       "finer, or with -order 1");
    if (curve->bow() > 1e-10)
      edge.curve = {curve, 0, 1};
    return edge;
  }

  /** Of elements of higher order: a curve that is a line is none. */
  void check_curve(CoarseMesh::Edge &edge) const
  {
    const auto *const polynomial = dynamic_cast<const PolynomialEdge *>(edge.curve.curve.get());
    const auto *const quadratic = dynamic_cast<const QuadraticEdge *>(edge.curve.curve.get());
    if ((polynomial && !polynomial->is_regular()) || (quadratic && !quadratic->is_regular()))
      complain(
          "the edge " + edge_in_words(mesh, edge.vertices) +
          " is on a curve that turns back; mesh finer" +
          (file.is_drawing ? ", as with Mesh size from curvature = 16" : ", or with -order 1"));
    if ((polynomial && polynomial->bow() <= 1e-10) || (quadratic && quadratic->bow() <= 1e-10))
      edge.curve = {};
  }

  const GmshFile &file;
  const std::vector<std::string> &wanted;
  const DrawingRequest &request;
  const MeshComplaint &complain;
  CoarseMesh mesh;
  std::set<std::pair<unsigned int, unsigned int>> left_out; ///< edges of other surfaces, by nodes
  std::vector<unsigned int> vertex_of;       ///< by node; CoarseMesh::inside: not used
  std::vector<unsigned int> nodes;           ///< by vertex
  std::vector<std::size_t> numbers_of_cells; ///< in the file
  std::vector<unsigned int> middles;         ///< nodes by edge; CoarseMesh::inside: none
  double size = 0, largest_z = 0;
  unsigned int highest = 0;
  std::size_t element_of_highest = 0;
};
} // namespace

CoarseMesh read_mesh_file(const std::string &path, const std::vector<std::string> &surfaces,
                          const DrawingRequest &request)
{
  GmshFile file = read_drawing(path, 2, request);
  const MeshComplaint complain(path);
  file.take_smallest_groups();
  number_groups(file, 2, request, complain);
  check_elements(file, complain);
  bend_lines(file, request);
  make_quadrilaterals(file, complain);
  return MeshMaker(file, surfaces, request, complain).make();
}
} // namespace hpvi
