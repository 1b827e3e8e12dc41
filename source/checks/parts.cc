// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/checks/checks.h>
#include <hpvi/checks/rejection.h>
#include <hpvi/scene/boundary_parts.h>

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

/** Rejects @p part where its Where begins or ends inside a face of the coarse mesh. */
template <int dim>
void check_ends(const Scene<dim> &scene, const BoundaryCondition<dim> &part)
{
  std::vector<std::vector<Point<dim>>> faces;
  double largest = 0;
  for (const CoarseFace<dim> &face : coarse_faces(scene.geometry, part.side))
  {
    faces.push_back(points_between<dim - 1, dim>(face.corners));
    for (const Point<dim> &x : faces.back())
      largest = std::max(largest, std::abs(part.where->value(x)));
  }
  const auto is_inside = [&](const Point<dim> &x) { return part.where->value(x) > 1e-9 * largest; };
  for (const std::vector<Point<dim>> &points : faces)
    for (const Point<dim> &x : points)
      if (is_inside(x) != is_inside(points.back()))
        reject(scene, section_of(part), "Where",
               "changes its sign inside a face of the coarse mesh, at " + to_string(x) +
                   "; end the part where Geometry/Subdivisions has a grid line");
  if (std::none_of(faces.begin(), faces.end(),
                   [&](const auto &points) { return is_inside(points.back()); }))
    reject(scene, section_of(part), "Where",
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
  for (unsigned int side = 0; side < GeometryInfo<dim>::faces_per_cell; ++side)
    for (const CoarseFace<dim> &face : coarse_faces(scene.geometry, side))
    {
      const Point<dim> x = centre_of<dim>(face.corners);
      const BoundaryCondition<dim> &first = scene.boundaries[boundary_at(scene, side, x)];
      for (const BoundaryCondition<dim> &other : scene.boundaries)
        if (other.id > first.id && other.side == side && other.where && other.where->value(x) > 0 &&
            first.where)
          reject(scene, section_of(other), "Where",
                 "overlaps " + mention(scene, section_of(first), "Where") + " at " + to_string(x) +
                     "; let each face belong to one part");
    }
}

template <int dim>
void check_material_places(const Scene<dim> &scene)
{
  if (!scene.material_at || !scene.parameters) // code knows its mesh
    return;
  std::array<std::vector<double>, dim> lines;
  for (unsigned int d = 0; d < dim; ++d)
    lines[d] = scene.geometry.grid_lines(d);
  std::vector<bool> is_used(scene.materials.size(), false);
  unsigned int n_cells = 1;
  for (unsigned int d = 0; d < dim; ++d)
    n_cells *= lines[d].size() - 1;
  for (unsigned int cell = 0; cell < n_cells; ++cell)
  {
    Corners<dim> corners;
    for (unsigned int v = 0; v < corners.size(); ++v)
    {
      Point<dim> unit;
      for (unsigned int d = 0, rest = cell; d < dim; rest /= lines[d++].size() - 1)
        unit[d] = lines[d][rest % (lines[d].size() - 1) + ((v >> d) & 1u)];
      corners[v] = scene.geometry.point(unit);
    }
    const std::vector<Point<dim>> points = points_between<dim, dim>(corners);
    const types::material_id material = scene.material_at(points.back());
    is_used.at(material) = true;
    for (const Point<dim> &x : points)
      if (const types::material_id other = scene.material_at(x); other != material)
        reject(scene, section_of_material(scene.materials[std::max(material, other)].name), "Where",
               "changes its sign inside a cell of the coarse mesh, at " + to_string(x) +
                   "; end the material where Geometry/Subdivisions has a grid line");
  }
  for (unsigned int m = 1; m < is_used.size(); ++m)
    if (!is_used[m])
      reject(scene, section_of_material(scene.materials[m].name), "Where",
             "is positive at the centre of no cell; give the material a place or remove it");
}

template void check_parts(const Scene<2> &);
template void check_parts(const Scene<3> &);
template void check_material_places(const Scene<2> &);
template void check_material_places(const Scene<3> &);
} // namespace hpvi
