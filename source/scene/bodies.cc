// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/bodies.h>

#include <algorithm>
#include <array>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A grid: vertices and cells row by row, edges along each side counterclockwise around the body. */
CoarseMesh cells_of_grid(const Geometry<2> &geometry)
{
  const std::vector<double> columns = geometry.grid_lines(0), rows = geometry.grid_lines(1);
  const unsigned int nx = columns.size() - 1, ny = rows.size() - 1;
  const auto vertex = [nx](const unsigned int i, const unsigned int j) { return j * (nx + 1) + i; };
  CoarseMesh mesh;
  mesh.boundaries = boundary_names(2);
  mesh.surfaces = {""};
  for (const double y : rows)
    for (const double x : columns)
      mesh.vertices.push_back(geometry.point({x, y}));
  for (unsigned int j = 0; j < ny; ++j)
    for (unsigned int i = 0; i < nx; ++i)
      mesh.cells.push_back(
          {{{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}}});
  for (unsigned int j = ny; j-- > 0;)
    mesh.edges.push_back({{{vertex(0, j + 1), vertex(0, j)}}, 0});
  for (unsigned int j = 0; j < ny; ++j)
    mesh.edges.push_back({{{vertex(nx, j), vertex(nx, j + 1)}}, 1});
  for (unsigned int i = 0; i < nx; ++i)
    mesh.edges.push_back({{{vertex(i, 0), vertex(i + 1, 0)}}, 2});
  for (unsigned int i = nx; i-- > 0;)
    mesh.edges.push_back({{{vertex(i + 1, ny), vertex(i, ny)}}, 3});
  return mesh;
}

/** A grid in space, x first. */
HexahedralMesh cells_of_grid(const Geometry<3> &geometry)
{
  std::array<std::vector<double>, 3> lines;
  std::array<unsigned int, 3> n;
  for (unsigned int d = 0; d < 3; ++d)
  {
    lines[d] = geometry.grid_lines(d);
    n[d] = lines[d].size() - 1;
  }
  const auto vertex = [&n](const std::array<unsigned int, 3> &at)
  { return (at[2] * (n[1] + 1) + at[1]) * (n[0] + 1) + at[0]; };
  HexahedralMesh mesh;
  mesh.boundaries = boundary_names(3);
  mesh.surfaces = {""};
  for (const double z : lines[2])
    for (const double y : lines[1])
      for (const double x : lines[0])
        mesh.corners.push_back(geometry.point({x, y, z}));
  std::array<unsigned int, 3> at;
  for (at[2] = 0; at[2] < n[2]; ++at[2])
    for (at[1] = 0; at[1] < n[1]; ++at[1])
      for (at[0] = 0; at[0] < n[0]; ++at[0])
      {
        std::array<unsigned int, HexahedralMesh::n_corners> corners;
        for (unsigned int v = 0; v < corners.size(); ++v)
          corners[v] = vertex({{at[0] + (v & 1u), at[1] + (v >> 1 & 1u), at[2] + (v >> 2)}});
        for (unsigned int face = 0; face < 6; ++face)
          if (at[face / 2] == (face % 2 == 0 ? 0 : n[face / 2] - 1))
          {
            HexahedralMesh::Face side{{}, face, static_cast<unsigned int>(mesh.hexahedra.size())};
            for (unsigned int v = 0; v < 4; ++v)
              side.vertices[v] = corners[GeometryInfo<3>::face_to_cell_vertices(face, v)];
            if (face % 2 == 0) // that (1-0) x (2-0) points outwards
              std::swap(side.vertices[1], side.vertices[2]);
            mesh.faces.push_back(side);
          }
        mesh.hexahedra.push_back(corners);
        mesh.cells.emplace_back();
      }
  return mesh;
}

/** Adds the surfaces and cells of @p own, of the body number @p body, behind what is there */
void append_cells(const CoarseMesh &own, const unsigned int body, CoarseMesh &all)
{
  const unsigned int first_vertex = all.vertices.size(), first_surface = all.surfaces.size();
  all.surfaces.insert(all.surfaces.end(), own.surfaces.begin(), own.surfaces.end());
  if (own.surfaces.empty()) // shapes have none
    all.surfaces.push_back("");
  for (CoarseMesh::Cell cell : own.cells)
  {
    all.is_numbered = all.is_numbered || own.is_numbered;
    for (unsigned int &vertex : cell.vertices)
      vertex += first_vertex;
    cell.surface += first_surface;
    cell.body = body;
    all.cells.push_back(cell);
  }
}

/** Adds @p own behind what is there, its boundaries from number @p first_side on. */
void append(const CoarseMesh &own, const unsigned int body, const unsigned int first_side,
            CoarseMesh &all)
{
  const unsigned int first_vertex = all.vertices.size();
  append_cells(own, body, all);
  all.vertices.insert(all.vertices.end(), own.vertices.begin(), own.vertices.end());
  for (CoarseMesh::Edge edge : own.edges)
  {
    for (unsigned int &vertex : edge.vertices)
      vertex += first_vertex;
    if (edge.boundary != CoarseMesh::inside)
      edge.boundary += first_side;
    all.edges.push_back(edge);
  }
}

void append(const HexahedralMesh &own, const unsigned int body, const unsigned int first_side,
            HexahedralMesh &all)
{
  const unsigned int first_corner = all.corners.size(), first_cell = all.hexahedra.size();
  append_cells(own, body, all);
  all.corners.insert(all.corners.end(), own.corners.begin(), own.corners.end());
  for (auto corners : own.hexahedra)
  {
    for (unsigned int &corner : corners)
      corner += first_corner;
    all.hexahedra.push_back(corners);
  }
  for (const auto &[cell, nodes] : own.bent)
    all.bent[first_cell + cell] = nodes;
  for (HexahedralMesh::Face face : own.faces)
  {
    for (unsigned int &corner : face.vertices)
      corner += first_corner;
    face.boundary += first_side;
    face.cell += first_cell;
    all.faces.push_back(face);
  }
}

/** Cells, bodies with their sides and the box around all, in @p all and the result. */
template <int dim, class Mesh>
Geometry<dim> joined(const std::vector<SingleBody<dim>> &bodies, Mesh &all)
{
  Geometry<dim> result;
  result.shape = Shape::bodies;
  Point<dim> lower = bodies.front().geometry.corners[0], upper = lower;
  for (unsigned int b = 0; b < bodies.size(); ++b)
  {
    const Geometry<dim> &geometry = bodies[b].geometry;
    const Mesh own = cells_of(geometry);
    Body<dim> body{bodies[b].name, {}, geometry.graded_towards, geometry.grading_levels};
    append(own, b, all.boundaries.size(), all);
    for (const std::string &side : own.boundaries)
    {
      body.sides.push_back(all.boundaries.size());
      all.boundaries.push_back(side.empty() ? "" : body.name + "." + side);
    }
    result.bodies.push_back(body);
    for (const Point<dim> &corner : geometry.corners)
      for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], corner[d]);
        upper[d] = std::max(upper[d], corner[d]);
      }
  }
  result.corners = box_corners(lower, upper);
  return result;
}
} // namespace

CoarseMesh cells_of(const Geometry<2> &geometry)
{
  return geometry.mesh ? *geometry.mesh : cells_of_grid(geometry);
}

HexahedralMesh cells_of(const Geometry<3> &geometry)
{
  return geometry.mesh ? *hexahedra_of(geometry) : cells_of_grid(geometry);
}

Geometry<2> geometry_of_bodies(const std::vector<SingleBody<2>> &bodies)
{
  CoarseMesh all;
  Geometry<2> result = joined(bodies, all);
  std::stable_partition(all.edges.begin(), all.edges.end(),
                        [](const CoarseMesh::Edge &edge)
                        { return edge.boundary != CoarseMesh::inside; });
  result.mesh = std::make_shared<const CoarseMesh>(std::move(all));
  return result;
}

Geometry<3> geometry_of_bodies(const std::vector<SingleBody<3>> &bodies)
{
  HexahedralMesh all;
  Geometry<3> result = joined(bodies, all);
  result.mesh = std::make_shared<const HexahedralMesh>(std::move(all));
  return result;
}
} // namespace hpvi
