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

std::string plural(const unsigned int n, const std::string &one, const std::string &many)
{
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

/** Of edges, faces or cells with one name. */
struct Total
{
  unsigned int n = 0, n_curved = 0;
  double size = 0;
  Point<2> from, to; ///< of the first edge and of the last

  void add(const double one)
  {
    ++n;
    size += one;
  }

  void add(const CoarseMesh &mesh, const CoarseMesh::Edge &edge)
  {
    from = n == 0 ? mesh.vertices[edge.vertices[0]] : from;
    to = mesh.vertices[edge.vertices[1]];
    n_curved += bool(edge.curve);
    add(length(mesh, edge));
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

std::string boundary_name(const std::string &name)
{
  return name.empty() ? "boundary without a name, free" : "boundary " + name;
}

/** As in "surface plate: 4 cells, area 16 mm^2" of each of @p names. */
void add_sizes(const std::string &kind, const std::vector<std::string> &names,
               const std::vector<Total> &totals, const std::string &size, const std::string &unit,
               std::vector<std::string> &lines)
{
  for (unsigned int k = 0; k < names.size(); ++k)
    lines.push_back(kind + names[k] + ": " + plural(totals[k].n, "cell", "cells") + ", " + size +
                    " " + with_unit(totals[k].size, unit));
}

std::string power(const std::string &unit, const std::string &exponent)
{
  return unit_name(unit).empty() ? "" : unit + exponent;
}
} // namespace

std::vector<std::string> boundaries_in_words(const CoarseMesh &mesh, const std::string &unit)
{
  std::vector<std::string> lines;
  std::vector<Total> boundaries(mesh.boundaries.size()), interfaces(mesh.interfaces.size());
  for (const CoarseMesh::Edge &edge : mesh.edges)
    if (edge.boundary != CoarseMesh::inside)
      boundaries[edge.boundary].add(mesh, edge);
    else if (edge.interface != CoarseMesh::inside)
      interfaces[edge.interface].add(mesh, edge);
  for (unsigned int b = 0; b < boundaries.size(); ++b)
    lines.push_back(
        boundary_name(mesh.boundaries[b]) + ": " + boundaries[b].words(unit) +
        (mesh.is_numbered // which curve of a drawing is which
             ? ", from " + to_string(boundaries[b].from) + " to " + to_string(boundaries[b].to)
             : ""));
  for (unsigned int i = 0; i < interfaces.size(); ++i)
    lines.push_back("curve inside " + mesh.interfaces[i] + ": " + interfaces[i].words(unit));
  return lines;
}

std::vector<std::string> mesh_words(const CoarseMesh &mesh, const std::string &length_unit)
{
  const CellFlaw widest = worst_cell(mesh);
  const EdgeCurves curves(mesh);
  std::vector<Total> surfaces(mesh.surfaces.size());
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    surfaces[mesh.cells[c].surface].add(area(BlendedCell(curves, c)));
  std::vector<std::string> lines = {"mesh: " + plural(mesh.cells.size(), "cell", "cells") + ", " +
                                    plural(mesh.vertices.size(), "vertex", "vertices") +
                                    ", largest angle " + to_string(widest.angle) + " degrees at " +
                                    to_string(widest.at)};
  for (const std::string &boundary : boundaries_in_words(mesh, length_unit))
    lines.push_back(boundary);
  add_sizes("surface ", mesh.surfaces, surfaces, "area", power(length_unit, "^2"), lines);
  return lines;
}

std::vector<std::string> mesh_words(const HexahedralMesh &mesh, const std::string &length_unit)
{
  std::vector<std::string> lines = {"mesh: " + plural(mesh.hexahedra.size(), "cell", "cells") +
                                    ", " + plural(mesh.corners.size(), "vertex", "vertices")};
  std::vector<Total> boundaries(mesh.boundaries.size()), volumes(mesh.surfaces.size());
  for (const HexahedralMesh::Face &face : mesh.faces)
    boundaries[face.boundary].add(area_of(mesh, face));
  for (unsigned int c = 0; c < mesh.hexahedra.size(); ++c)
    volumes[mesh.cells[c].surface].add(volume_of(mesh, c));
  for (unsigned int b = 0; b < boundaries.size(); ++b)
    lines.push_back(boundary_name(mesh.boundaries[b]) + ": " +
                    plural(boundaries[b].n, "face", "faces") + ", area " +
                    with_unit(boundaries[b].size, power(length_unit, "^2")));
  add_sizes("volume ", mesh.surfaces, volumes, "volume", power(length_unit, "^3"), lines);
  return lines;
}
} // namespace hpvi
