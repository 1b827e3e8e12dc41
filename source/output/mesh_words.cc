// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/mesh_words.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

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

/** Of a cell with plane faces, which are bases of pyramids. */
double volume_of(const Corners<3> &cell)
{
  double result = 0;
  for (unsigned int f = 0; f < GeometryInfo<3>::faces_per_cell; ++f)
  {
    Side<3>::Piece face;
    for (unsigned int v = 0; v < face.size(); ++v)
      face[v] = cell[GeometryInfo<3>::face_to_cell_vertices(f, v)];
    result += area_of(face) * std::abs(normal_of(face) * (centre_of(cell) - face[0])) / 3;
  }
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
  Point<2> from, to; ///< of the first edge and of the last

  void add(const CoarseMesh &mesh, const CoarseMesh::Edge &edge)
  {
    from = n == 0 ? mesh.vertices[edge.vertices[0]] : from;
    to = mesh.vertices[edge.vertices[1]];
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

/** Which curve of a drawing is which. */
std::string ends_in_words(const Total &curve)
{
  const auto place = [](const Point<2> &x)
  { return "(" + text(x[0], 6) + ", " + text(x[1], 6) + ")"; };
  return ", from " + place(curve.from) + " to " + place(curve.to);
}

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
                    ": " + boundaries[b].words(unit) +
                    (mesh.is_numbered ? ends_in_words(boundaries[b]) : ""));
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

std::vector<std::string> boundaries_in_words(const CoarseMesh &mesh, const std::string &length_unit)
{
  std::vector<std::string> lines;
  add_edges(mesh, length_unit, lines);
  return lines;
}

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

std::vector<std::string> mesh_words(const HexahedralMesh &mesh, const std::string &length_unit)
{
  const auto power = [&](const std::string &exponent)
  { return unit_name(length_unit).empty() ? "" : length_unit + exponent; };
  std::vector<std::string> lines = {"mesh: " + plural(mesh.hexahedra.size(), "cell", "cells") +
                                    ", " + plural(mesh.corners.size(), "vertex", "vertices")};
  std::vector<Total> boundaries(mesh.boundaries.size()), volumes(mesh.surfaces.size());
  for (const HexahedralMesh::Face &face : mesh.faces)
  {
    ++boundaries[face.boundary].n;
    boundaries[face.boundary].size += area_of(mesh.corners_of(face));
  }
  for (unsigned int c = 0; c < mesh.hexahedra.size(); ++c)
  {
    Total &volume = volumes[mesh.cells[c].surface];
    ++volume.n;
    volume.size += volume_of(mesh.corners_of(c));
  }
  for (unsigned int b = 0; b < boundaries.size(); ++b)
    lines.push_back((mesh.boundaries[b].empty() ? "boundary without a name, free"
                                                : "boundary " + mesh.boundaries[b]) +
                    ": " + plural(boundaries[b].n, "face", "faces") + ", area " +
                    with_unit(boundaries[b].size, power("^2")));
  for (unsigned int v = 0; v < volumes.size(); ++v)
    lines.push_back("volume " + mesh.surfaces[v] + ": " + plural(volumes[v].n, "cell", "cells") +
                    ", volume " + with_unit(volumes[v].size, power("^3")));
  return lines;
}
} // namespace hpvi
