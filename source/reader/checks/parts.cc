// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <functional>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Gauss points between corners that stand in lexicographic order; the last one is the middle. */
template <int n, int dim>
std::vector<Point<dim>> points_between(const std::array<Point<dim>, 1u << n> &corners)
{
  const QGauss<n> gauss(5);
  std::vector<Point<dim>> result;
  for (unsigned int q = 0; q <= gauss.size(); ++q)
  {
    Point<n> s;
    for (unsigned int d = 0; d < n; ++d)
      s[d] = q < gauss.size() ? gauss.point(q)[d] : 0.5;
    Point<dim> x;
    for (unsigned int v = 0; v < corners.size(); ++v)
    {
      double weight = 1;
      for (unsigned int d = 0; d < n; ++d)
        weight *= (v >> d) & 1u ? s[d] : 1 - s[d];
      x += weight * corners[v];
    }
    result.push_back(x);
  }
  return result;
}

template <int dim>
std::vector<Point<dim>> points_on(const CoarseFace<dim> &face)
{
  if (!face.curve)
    return points_between<dim - 1, dim>(face.corners);
  std::vector<Point<dim>> result;
  if constexpr (dim == 2)
    for (const Point<1> &s : points_between<1, 1>({{Point<1>(0.), Point<1>(1.)}}))
      result.push_back(face.curve.point(s[0]));
  else
    for (const Point<2> &xi :
         points_between<2, 2>({{Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1), Point<2>(1, 1)}}))
      result.push_back(face.curve.point(xi));
  return result;
}

/** Between @p one and @p other, of which one alone is inside, where that changes. */
template <int dim>
Point<dim> change_between(const std::function<bool(const Point<dim> &)> &is_inside, Point<dim> one,
                          Point<dim> other)
{
  const bool begins_inside = is_inside(one);
  for (unsigned int k = 0; k < 50; ++k)
  {
    const Point<dim> middle = one + 0.5 * (other - one);
    (is_inside(middle) == begins_inside ? one : other) = middle;
  }
  return other;
}

/** Which entry says where it is. */
template <int dim>
std::string place_entry(const BoundaryCondition<dim> &part)
{
  return part.pair ? "Between" : "Where";
}

/** Rejects @p part where its Where begins or ends inside a face of the coarse mesh. */
template <int dim>
void check_ends(const Scene<dim> &scene, const BoundaryCondition<dim> &part)
{
  std::vector<std::vector<Point<dim>>> faces;
  double largest = 0;
  for (const CoarseFace<dim> &face : coarse_faces(scene.geometry, part.side))
  {
    faces.push_back(points_on(face));
    for (const Point<dim> &x : faces.back())
      largest = std::max(largest, std::abs(part.where->value(x)));
  }
  const auto is_inside = [&](const Point<dim> &x) { return part.where->value(x) > 1e-9 * largest; };
  for (const std::vector<Point<dim>> &points : faces)
    for (const Point<dim> &x : points)
      if (is_inside(x) != is_inside(points.back()))
        reject(scene, section_of(part), place_entry(part),
               "changes its sign inside a face of the coarse mesh, at " +
                   to_string(change_between<dim>(is_inside, x, points.back())) +
                   "; end the part where " +
                   (scene.geometry.has_mesh() ? "the mesh has a vertex"
                                              : "Geometry/Subdivisions has a grid line"));
  if (std::none_of(faces.begin(), faces.end(),
                   [&](const auto &points) { return is_inside(points.back()); }))
    reject(scene, section_of(part), place_entry(part),
           "is positive nowhere on " + scene.boundaries[part.side].name +
               "; give a function that is positive on the part");
}
} // namespace

template <int dim>
void check_parts(const Scene<dim> &scene)
{
  for (const BoundaryCondition<dim> &part : scene.boundaries)
    if (part.where)
      check_ends(scene, part);
  for (unsigned int side = 0; side < scene.geometry.boundary_names().size(); ++side)
    for (const CoarseFace<dim> &face : coarse_faces(scene.geometry, side))
    {
      const Point<dim> x = middle_of(face);
      const BoundaryCondition<dim> &first = scene.boundaries[boundary_at(scene, side, x)];
      for (const BoundaryCondition<dim> &other : scene.boundaries)
        if (other.id > first.id && other.side == side && other.where && other.where->value(x) > 0 &&
            first.where)
          reject(scene, section_of(other), place_entry(other),
                 "overlaps " + mention(scene, section_of(first), place_entry(first)) + " at " +
                     to_string(x) + "; let each face belong to one part");
    }
}

namespace
{
/** Points of each cell of the coarse mesh before it is graded; the last one is the middle. */
template <int dim>
std::vector<std::vector<Point<dim>>> points_of_cells(const Geometry<dim> &geometry)
{
  std::vector<std::vector<Point<dim>>> result;
  if constexpr (dim == 2)
    if (geometry.mesh)
    {
      const EdgeCurves curves(*geometry.mesh);
      const auto unit = points_between<2, 2>(box_corners<2>({0, 0}, {1, 1}));
      for (unsigned int c = 0; c < geometry.mesh->cells.size(); ++c)
      {
        const BlendedCell cell(curves, c);
        result.emplace_back();
        for (const Point<2> &s : unit)
          result.back().push_back(cell.point(s[0], s[1]));
      }
      return result;
    }
  if constexpr (dim == 3)
    if (geometry.mesh)
    {
      const HexahedralMesh &mesh = *hexahedra_of(geometry);
      for (unsigned int c = 0; c < mesh.hexahedra.size(); ++c)
        result.push_back(points_between<3, 3>(mesh.corners_of(c)));
      return result;
    }
  std::array<std::vector<double>, dim> lines;
  unsigned int n_cells = 1;
  for (unsigned int d = 0; d < dim; ++d)
  {
    lines[d] = geometry.grid_lines(d);
    n_cells *= lines[d].size() - 1;
  }
  for (unsigned int cell = 0; cell < n_cells; ++cell)
  {
    Corners<dim> corners;
    for (unsigned int v = 0; v < corners.size(); ++v)
    {
      Point<dim> unit;
      for (unsigned int d = 0, rest = cell; d < dim; rest /= lines[d++].size() - 1)
        unit[d] = lines[d][rest % (lines[d].size() - 1) + ((v >> d) & 1u)];
      corners[v] = geometry.point(unit);
    }
    result.push_back(points_between<dim, dim>(corners));
  }
  return result;
}
} // namespace

namespace
{
/** Of a coarse cell whose surface has one of its own. */
template <int dim>
std::optional<types::material_id> material_of_surface(const Scene<dim> &scene,
                                                      const unsigned int cell)
{
  if (scene.material_of_surface.empty())
    return std::nullopt;
  return scene.material_of_surface[scene.geometry.mesh->cells[cell].surface];
}
} // namespace

template <int dim>
void check_material_places(const Scene<dim> &scene)
{
  if (!scene.material_at || !scene.parameters) // code knows its mesh
    return;
  std::vector<bool> is_used(scene.materials.size(), false);
  const std::vector<std::vector<Point<dim>>> cells = points_of_cells(scene.geometry);
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
  {
    if (const auto own = material_of_surface(scene, cell))
    {
      is_used.at(*own) = true;
      continue;
    }
    const std::vector<Point<dim>> &points = cells[cell];
    const types::material_id material = scene.material_at(points.back());
    is_used.at(material) = true;
    for (const Point<dim> &x : points)
      if (const types::material_id other = scene.material_at(x); other != material)
        reject(scene, section_of_material(scene.materials[std::max(material, other)].name), "Where",
               "changes its sign inside a cell of the coarse mesh, at " +
                   to_string(change_between<dim>([&](const Point<dim> &at)
                                                 { return scene.material_at(at) == material; },
                                                 x, points.back())) +
                   "; end the material where " +
                   (scene.geometry.has_mesh() ? "cells meet"
                                              : "Geometry/Subdivisions has a grid line"));
  }
  for (unsigned int m = 1; m < is_used.size(); ++m)
    if (!is_used[m] && material_beside(scene, m) == m)
      reject(scene, section_of_material(scene.materials[m].name), "Where",
             "is positive at the centre of no cell; give the material a place or remove it");
}

template void check_parts(const Scene<2> &);
template void check_parts(const Scene<3> &);
template void check_material_places(const Scene<2> &);
template void check_material_places(const Scene<3> &);
} // namespace hpvi
