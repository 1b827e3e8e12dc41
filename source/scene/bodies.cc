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

/** Adds @p own behind what is there, its boundaries from number @p first_side on. */
void append(const CoarseMesh &own, const unsigned int body, const unsigned int first_side,
            CoarseMesh &all)
{
  const unsigned int first_vertex = all.vertices.size(), first_surface = all.surfaces.size();
  all.surfaces.insert(all.surfaces.end(), own.surfaces.begin(), own.surfaces.end());
  if (own.surfaces.empty()) // shapes have none
    all.surfaces.push_back("");
  all.vertices.insert(all.vertices.end(), own.vertices.begin(), own.vertices.end());
  for (CoarseMesh::Cell cell : own.cells)
  {
    all.is_numbered = all.is_numbered || own.is_numbered;
    for (unsigned int &vertex : cell.vertices)
      vertex += first_vertex;
    cell.surface += first_surface;
    cell.body = body;
    all.cells.push_back(cell);
  }
  for (CoarseMesh::Edge edge : own.edges)
  {
    for (unsigned int &vertex : edge.vertices)
      vertex += first_vertex;
    if (edge.boundary != CoarseMesh::inside)
      edge.boundary += first_side;
    all.edges.push_back(edge);
  }
}
} // namespace

CoarseMesh cells_of(const Geometry<2> &geometry)
{
  return geometry.mesh ? *geometry.mesh : cells_of_grid(geometry);
}

Geometry<2> geometry_of_bodies(const std::vector<SingleBody> &bodies)
{
  CoarseMesh all;
  Geometry<2> result;
  result.shape = Shape::bodies;
  result.corners = bodies.front().geometry.corners;
  Point<2> lower = result.corners[0], upper = lower;
  for (unsigned int b = 0; b < bodies.size(); ++b)
  {
    const Geometry<2> &geometry = bodies[b].geometry;
    const CoarseMesh own = cells_of(geometry);
    Body<2> body{bodies[b].name, {}, geometry.graded_towards, geometry.grading_levels};
    append(own, b, all.boundaries.size(), all);
    for (const std::string &side : own.boundaries)
    {
      body.sides.push_back(all.boundaries.size());
      all.boundaries.push_back(side.empty() ? "" : body.name + "." + side);
    }
    result.bodies.push_back(body);
    for (const Point<2> &corner : geometry.corners)
      for (unsigned int d = 0; d < 2; ++d)
      {
        lower[d] = std::min(lower[d], corner[d]);
        upper[d] = std::max(upper[d], corner[d]);
      }
  }
  std::stable_partition(all.edges.begin(), all.edges.end(),
                        [](const CoarseMesh::Edge &edge)
                        { return edge.boundary != CoarseMesh::inside; });
  result.mesh = std::make_shared<const CoarseMesh>(std::move(all));
  result.corners = box_corners(lower, upper);
  return result;
}
} // namespace hpvi
