// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/mesh_words.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Edges of cells by their two vertices, in either direction. */
class EdgeLookup
{
public:
  explicit EdgeLookup(const CoarseMesh &mesh) : mesh(mesh)
  {
    for (const CoarseMesh::Edge &edge : mesh.edges)
      if (edge.curve)
      {
        curves[{edge.vertices[0], edge.vertices[1]}] = edge.curve;
        curves[{edge.vertices[1], edge.vertices[0]}] = edge.curve.between(1, 0);
      }
  }

  /** Of the edge that begins at corner @p k of @p cell, by s from 0 to 1. */
  Tensor<1, 2> derivative(const CoarseMesh::Cell &cell, const unsigned int k, const double s) const
  {
    const CurvePiece *const curve = find(cell, k);
    return curve != nullptr ? curve->derivative(s) : end(cell, k + 1) - end(cell, k);
  }

  Point<2> point(const CoarseMesh::Cell &cell, const unsigned int k, const double s) const
  {
    const CurvePiece *const curve = find(cell, k);
    return curve != nullptr ? curve->point(s)
                            : end(cell, k) + s * (end(cell, k + 1) - end(cell, k));
  }

private:
  Point<2> end(const CoarseMesh::Cell &cell, const unsigned int k) const
  {
    return mesh.vertices[cell.vertices[k % 4]];
  }

  const CurvePiece *find(const CoarseMesh::Cell &cell, const unsigned int k) const
  {
    const auto found = curves.find({cell.vertices[k % 4], cell.vertices[(k + 1) % 4]});
    return found == curves.end() ? nullptr : &found->second;
  }

  const CoarseMesh &mesh;
  std::map<std::pair<unsigned int, unsigned int>, CurvePiece> curves;
};

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

/** By Green's formula, about one of its corners: a small cell may be far from the origin. */
double area(const CoarseMesh &mesh, const EdgeLookup &edges, const CoarseMesh::Cell &cell)
{
  static const QGauss<1> gauss(12);
  const Point<2> origin = mesh.vertices[cell.vertices[0]];
  double result = 0;
  for (unsigned int k = 0; k < 4; ++k)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double s = gauss.point(q)[0];
      const Tensor<1, 2> x = edges.point(cell, k, s) - origin, along = edges.derivative(cell, k, s);
      result += 0.5 * gauss.weight(q) * (x[0] * along[1] - x[1] * along[0]);
    }
  return result;
}

WidestCorner widest_corner(const CoarseMesh &mesh, const EdgeLookup &edges)
{
  WidestCorner widest;
  for (const CoarseMesh::Cell &cell : mesh.cells)
    for (unsigned int k = 0; k < 4; ++k)
    {
      const Tensor<1, 2> one = edges.derivative(cell, k, 0),
                         two = -edges.derivative(cell, (k + 3) % 4, 1);
      const double angle =
          std::atan2(one[0] * two[1] - one[1] * two[0], one * two) * 180 / numbers::PI;
      const double degrees = angle < -1e-9 ? angle + 360 : angle; // curves may meet at none
      if (degrees > widest.degrees + 1e-9)                        // round-off does not choose
        widest = {mesh.vertices[cell.vertices[k]], degrees};
    }
  return widest;
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

void add_surfaces(const CoarseMesh &mesh, const EdgeLookup &edges, const std::string &unit,
                  std::vector<std::string> &lines)
{
  std::vector<Total> surfaces(mesh.surfaces.size());
  for (const CoarseMesh::Cell &cell : mesh.cells)
  {
    ++surfaces[cell.surface].n;
    surfaces[cell.surface].size += area(mesh, edges, cell);
  }
  for (unsigned int s = 0; s < surfaces.size(); ++s)
    lines.push_back("surface " + mesh.surfaces[s] + ": " + plural(surfaces[s].n, "cell", "cells") +
                    ", area " +
                    with_unit(surfaces[s].size, unit_name(unit).empty() ? "" : unit + "^2"));
}
} // namespace

WidestCorner widest_corner(const CoarseMesh &mesh)
{
  return widest_corner(mesh, EdgeLookup(mesh));
}

std::vector<std::string> mesh_words(const CoarseMesh &mesh, const std::string &length_unit)
{
  const EdgeLookup edges(mesh);
  const WidestCorner widest = widest_corner(mesh, edges);
  std::vector<std::string> lines = {"mesh: " + plural(mesh.cells.size(), "cell", "cells") + ", " +
                                    plural(mesh.vertices.size(), "vertex", "vertices") +
                                    ", largest angle " + to_string(widest.degrees) +
                                    " degrees at " + to_string(widest.at)};
  add_edges(mesh, length_unit, lines);
  add_surfaces(mesh, edges, length_unit, lines);
  return lines;
}
} // namespace hpvi
