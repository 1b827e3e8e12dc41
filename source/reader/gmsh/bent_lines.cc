// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/bent_lines.h>
#include <hpvi/reader/shapes/curve_fit.h>

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

Point<2> place(const GmshFile &file, const unsigned int node)
{
  return Point<2>(file.nodes[node].at[0], file.nodes[node].at[1]);
}

/** Edges of cells counterclockwise, by their ends, the smaller first: of two cells that of one. */
std::map<Ends, Ends> directed_edges(const GmshFile &file)
{
  std::map<Ends, Ends> result;
  for (const GmshFile::Element &element : file.elements)
  {
    const ElementKind kind = element_kind(element.type);
    if (kind.dim != 2 || kind.n_nodes == 0)
      continue;
    double area = 0;
    for (unsigned int k = 0; k < kind.n_corners; ++k)
    {
      const Point<2> a = place(file, element.nodes[k]),
                     b = place(file, element.nodes[(k + 1) % kind.n_corners]);
      area += a[0] * b[1] - a[1] * b[0];
    }
    for (unsigned int k = 0; k < kind.n_corners; ++k)
    {
      Ends ends{{element.nodes[k], element.nodes[(k + 1) % kind.n_corners]}};
      const Ends key{{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])}};
      if (area < 0)
        std::swap(ends[0], ends[1]);
      result[key] = ends;
    }
  }
  return result;
}

/** The straight lines of each group as edges between all nodes. */
std::map<std::int64_t, CoarseMesh> lines_by_group(const GmshFile &file)
{
  const std::map<Ends, Ends> directed = directed_edges(file);
  std::map<std::int64_t, CoarseMesh> result;
  for (const GmshFile::Element &element : file.elements)
  {
    if (element_kind(element.type).dim != 1 || element.group == 0)
      continue;
    const auto [low, high] = std::minmax({element.nodes[0], element.nodes[1]});
    const auto found = directed.find({{low, high}});
    if (found == directed.end() || file.curve(low, high) || element_kind(element.type).n_nodes > 2)
      continue;
    CoarseMesh::Edge edge;
    edge.vertices = found->second;
    result[element.group].edges.push_back(edge);
  }
  for (auto &[group, mesh] : result)
    for (unsigned int node = 0; node < file.nodes.size(); ++node)
      mesh.vertices.push_back(place(file, node));
  return result;
}

std::vector<unsigned int> all_edges(const CoarseMesh &mesh)
{
  std::vector<unsigned int> result(mesh.edges.size());
  std::iota(result.begin(), result.end(), 0);
  return result;
}
} // namespace

void bend_lines(GmshFile &file, const DrawingRequest &request)
{
  const bool has_triangles = std::any_of(file.elements.begin(), file.elements.end(),
                                         [](const GmshFile::Element &element) {
                                           return element.type == 2;
                                         }); // those of second order have curves
  if (file.is_drawing || (request.bent.empty() && !has_triangles))
    return;
  for (auto &[group, mesh] : lines_by_group(file))
  {
    const auto known = file.names.find({1, group});
    const std::string name =
        known == file.names.end() ? std::to_string(group) : printable(known->second);
    const auto curve = request.bent.find(name);
    if (curve == request.bent.end())
    {
      if (const auto fit = polygon_for_circle(mesh, all_edges(mesh)); fit && has_triangles)
        file.remarks.push_back(polygon_words(name, *fit, false));
      continue;
    }
    const std::string flaw = curve->second == "circle" ? bend_to_circles(mesh, all_edges(mesh))
                                                       : bend_to_splines(mesh, all_edges(mesh));
    for (const CoarseMesh::Edge &edge : mesh.edges)
      if (flaw.empty()) // else it is told where all edges are bent
        file.set_curve(edge.vertices[0], edge.vertices[1], edge.curve);
  }
}
} // namespace hpvi
