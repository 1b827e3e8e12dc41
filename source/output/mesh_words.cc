// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/mesh_words.h>

#include <deal.II/base/quadrature_lib.h>

namespace hpvi
{
using namespace dealii;

namespace
{
double length(const CoarseMesh &mesh, const CoarseMesh::Edge &edge)
{
  if (!edge.curve)
    return mesh.vertices[edge.vertices[0]].distance(mesh.vertices[edge.vertices[1]]);
  static const QGauss<1> gauss(12);
  double result = 0;
  for (unsigned int q = 0; q < gauss.size(); ++q)
    result += gauss.weight(q) * edge.curve.derivative(gauss.point(q)[0]).norm();
  return result;
}

double area(const BlendedCell &cell)
{
  static const QGauss<2> gauss(12);
  double result = 0;
  for (unsigned int q = 0; q < gauss.size(); ++q)
    result += gauss.weight(q) * cell.determinant(gauss.point(q)[0], gauss.point(q)[1]);
  return result;
}

std::string plural(const unsigned int n, const std::string &one, const std::string &many)
{
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

/** Of edges with one name. */
struct Total
{
  unsigned int n = 0, n_curved = 0;
  double size = 0;

  void add(const CoarseMesh &mesh, const CoarseMesh::Edge &edge)
  {
    ++n;
    n_curved += bool(edge.curve);
    size += length(mesh, edge);
  }

  std::string words(const std::string &unit) const
  {
    return plural(n, "edge", "edges") +
           (n_curved == 0   ? ""
            : n_curved == n ? ", curved"
                            : ", " + std::to_string(n_curved) + " of them curved") +
           ", length " + with_unit(size, unit);
  }
};

void add_edges(const CoarseMesh &mesh, const std::string &unit, std::vector<std::string> &lines)
{
  std::vector<Total> boundaries(mesh.boundaries.size()), interfaces(mesh.interfaces.size());
  for (const CoarseMesh::Edge &edge : mesh.edges)
    if (edge.boundary != CoarseMesh::inside)
      boundaries[edge.boundary].add(mesh, edge);
    else if (edge.interface != CoarseMesh::inside)
      interfaces[edge.interface].add(mesh, edge);
  for (unsigned int b = 0; b < boundaries.size(); ++b)
    lines.push_back((mesh.boundaries[b].empty() ? "boundary without a name, free"
                                                : "boundary " + mesh.boundaries[b]) +
                    ": " + boundaries[b].words(unit));
  for (unsigned int i = 0; i < interfaces.size(); ++i)
    lines.push_back("curve inside " + mesh.interfaces[i] + ": " + interfaces[i].words(unit));
}

void add_surfaces(const CoarseMesh &mesh, const std::string &unit, std::vector<std::string> &lines)
{
  std::vector<Total> surfaces(mesh.surfaces.size());
  const EdgeCurves curves(mesh);
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
  {
    Total &surface = surfaces[mesh.cells[c].surface];
    ++surface.n;
    surface.size += area(BlendedCell(curves, c));
  }
  for (unsigned int s = 0; s < surfaces.size(); ++s)
    lines.push_back("surface " + mesh.surfaces[s] + ": " + plural(surfaces[s].n, "cell", "cells") +
                    ", area " +
                    with_unit(surfaces[s].size, unit_name(unit).empty() ? "" : unit + "^2"));
}
} // namespace

std::vector<std::string> mesh_words(const CoarseMesh &mesh, const std::string &length_unit)
{
  const CellFlaw widest = worst_cell(mesh);
  std::vector<std::string> lines = {"mesh: " + plural(mesh.cells.size(), "cell", "cells") + ", " +
                                    plural(mesh.vertices.size(), "vertex", "vertices") +
                                    ", largest angle " + to_string(widest.angle) + " degrees at " +
                                    to_string(widest.at)};
  add_edges(mesh, length_unit, lines);
  add_surfaces(mesh, length_unit, lines);
  return lines;
}
} // namespace hpvi
