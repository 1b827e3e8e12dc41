// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace hpvi
{
using namespace dealii;

template <int dim>
types::boundary_id boundary_at(const Scene<dim> &scene, const unsigned int side,
                               const Point<dim> &x)
{
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    if (boundary.side == side && boundary.where && boundary.where->value(x) > 0)
      return boundary.id;
  return side;
}

template <int dim>
Point<dim> middle_of(const CoarseFace<dim> &face)
{
  if (face.curve)
  {
    if constexpr (dim == 2)
      return face.curve.point(0.5);
    else
      return face.curve.point(Point<2>(0.5, 0.5));
  }
  return centre_of<dim>(face.corners);
}

namespace
{
std::vector<CoarseFace<2>> faces_of_mesh(const CoarseMesh &mesh, const unsigned int side)
{
  std::vector<bool> is_on_side(mesh.vertices.size());
  for (const CoarseMesh::Edge &edge : mesh.edges)
    if (edge.boundary == side)
      for (const unsigned int vertex : edge.vertices)
        is_on_side[vertex] = true;
  // By an edge counterclockwise around them. Scenes ask often, and few edges of a large mesh are on a side.
  std::map<std::array<unsigned int, 2>, unsigned int> cells;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    for (unsigned int v = 0; v < 4; ++v)
      if (const std::array<unsigned int, 2> edge{
              {mesh.cells[c].vertices[v], mesh.cells[c].vertices[(v + 1) % 4]}};
          is_on_side[edge[0]] && is_on_side[edge[1]])
        cells[edge] = c;
  const EdgeCurves curves(mesh);
  std::vector<CoarseFace<2>> result;
  for (const CoarseMesh::Edge &edge : mesh.edges)
    if (edge.boundary == side)
    {
      CoarseFace<2> face;
      for (unsigned int end = 0; end < 2; ++end)
        face.corners[end] = mesh.vertices[edge.vertices[end]];
      face.cell = cells.at(edge.vertices);
      face.inside = BlendedCell(curves, face.cell).point(0.5, 0.5);
      face.curve = edge.curve;
      result.push_back(face);
    }
  return result;
}

std::vector<CoarseFace<3>> faces_of_mesh(const HexahedralMesh &mesh, const unsigned int side)
{
  std::vector<CoarseFace<3>> result;
  for (const HexahedralMesh::Face &face : mesh.faces)
    if (face.boundary == side)
    {
      const auto bent = mesh.bent.find(face.cell);
      result.push_back(
          {mesh.corners_of(face),
           bent == mesh.bent.end() ? centre_of(mesh.corners_of(face.cell)) : bent->second[13],
           mesh.curve_of(face), face.cell});
    }
  return result;
}
} // namespace

template <int dim>
std::vector<CoarseFace<dim>> coarse_faces(const Geometry<dim> &geometry, const unsigned int side)
{
  if constexpr (dim == 2)
    if (geometry.mesh)
      return faces_of_mesh(*geometry.mesh, side);
  if constexpr (dim == 3)
    if (geometry.mesh)
      return faces_of_mesh(*hexahedra_of(geometry), side);
  const unsigned int across = side / 2;
  std::array<std::vector<double>, dim> lines;
  for (unsigned int d = 0; d < dim; ++d)
    lines[d] = geometry.grid_lines(d);
  const unsigned int first = across == 0 ? 1 : 0, // direction along the side
      second = across == 2 ? 1 : 2,               // the other one in space
      n_second = dim == 3 ? lines[second % dim].size() - 1 : 1;
  const double outer = side % 2,
               next = side % 2 == 0 ? lines[across][1] : *(lines[across].end() - 2);
  std::vector<CoarseFace<dim>> result;
  for (unsigned int j = 0; j < n_second; ++j)
    for (unsigned int i = 0; i + 1 < lines[first].size(); ++i)
    {
      CoarseFace<dim> face;
      Point<dim> inside;
      inside[across] = (outer + next) / 2;
      for (unsigned int v = 0; v < face.corners.size(); ++v)
      {
        Point<dim> unit;
        unit[across] = outer;
        unit[first] = lines[first][i + (v & 1u)];
        if (dim == 3)
          unit[second % dim] = lines[second % dim][j + (v >> 1)];
        face.corners[v] = geometry.point(unit);
        for (unsigned int d = 0; d < dim; ++d)
          inside[d] += d == across ? 0. : unit[d] / face.corners.size();
      }
      face.inside = geometry.point(inside);
      result.push_back(face);
    }
  return result;
}

template <int dim>
std::vector<Side<dim>> sides_of(const Scene<dim> &scene)
{
  const std::vector<Side<dim>> whole = sides_of(scene.geometry);
  if (!scene.has_parts())
    return whole;
  std::vector<Side<dim>> result;
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    result.push_back(whole[boundary.side]);
    result.back().pieces.clear();
    result.back().curves.clear();
  }
  for (unsigned int side = 0; side < whole.size(); ++side)
    for (const CoarseFace<dim> &face : coarse_faces(scene.geometry, side))
    {
      Side<dim> &part = result[boundary_at(scene, side, middle_of(face))];
      if (dim == 2 && part.is_flat() && !part.pieces.empty() &&
          part.pieces.back()[1] == face.corners[0])
        part.pieces.back()[1] = face.corners[1];
      else
      {
        part.pieces.push_back(face.corners);
        part.curves.push_back(face.curve);
      }
    }
  return result;
}

template <int dim>
Tensor<1, dim> common_normal(const Side<dim> &side)
{
  if (side.is_flat() || side.pieces.empty())
    return side.outward;
  Tensor<1, dim> result;
  for (unsigned int k = 0; k < side.pieces.size(); ++k)
  {
    Tensor<1, dim> normal;
    if constexpr (dim == 3)
    {
      if (const CurvedFace curve = side.curve(k); curve && !curve.is_plane())
        return {};
      normal = normal_of(side.pieces[k]);
    }
    else
    {
      if (side.curve(k))
        return {};
      normal = side.normal(k, 0.5);
    }
    for (unsigned int d = 0; d < dim; ++d)
      normal[d] = std::abs(normal[d]) < same_direction ? 0. : normal[d];
    normal /= normal.norm();
    if (k > 0 && (normal - result).norm() > same_direction)
      return {};
    result = k > 0 ? result : normal;
  }
  return result;
}

template <int dim>
std::string name_and_place(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary)
{
  const Side<dim> side = sides_of(scene)[boundary.id];
  const Tensor<1, dim> normal = common_normal(side);
  const auto is_in_one_plane = [&](const unsigned int d)
  {
    const double at = side.pieces[0][0][d], hair = same_place * scene.geometry.diameter();
    return std::all_of(side.pieces.begin(), side.pieces.end(),
                       [&](const auto &piece) { return std::abs(piece[0][d] - at) < hair; });
  };
  for (unsigned int d = 0; d < dim && dim == 3 && !side.pieces.empty(); ++d)
    if (std::abs(normal[d]) > 1 - same_direction && is_in_one_plane(d))
      return boundary.name + " (" + "xyz"[d] + " = " + text(side.pieces[0][0][d], 6) + ")";
  return boundary.name;
}

template <int dim>
bool lies_on_axis(const Side<dim> &side)
{
  const std::vector<Point<dim>> points = side.sample();
  return !points.empty() &&
         std::all_of(points.begin(), points.end(), [](const Point<dim> &x) { return x[0] == 0; });
}

template types::boundary_id boundary_at(const Scene<2> &, unsigned int, const Point<2> &);
template types::boundary_id boundary_at(const Scene<3> &, unsigned int, const Point<3> &);
template Point<2> middle_of(const CoarseFace<2> &);
template Point<3> middle_of(const CoarseFace<3> &);
template Tensor<1, 2> common_normal(const Side<2> &);
template Tensor<1, 3> common_normal(const Side<3> &);
template std::string name_and_place(const Scene<2> &, const BoundaryCondition<2> &);
template std::string name_and_place(const Scene<3> &, const BoundaryCondition<3> &);
template bool lies_on_axis(const Side<2> &);
template bool lies_on_axis(const Side<3> &);
template std::vector<CoarseFace<2>> coarse_faces(const Geometry<2> &, unsigned int);
template std::vector<CoarseFace<3>> coarse_faces(const Geometry<3> &, unsigned int);
template std::vector<Side<2>> sides_of(const Scene<2> &);
template std::vector<Side<3>> sides_of(const Scene<3> &);
} // namespace hpvi
