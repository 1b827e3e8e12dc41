// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/checks/rejection.h>
#include <hpvi/reader/shapes/shape.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Without squares, which over- and underflow. */
template <int dim>
double length(const Tensor<1, dim> &edge)
{
  double result = 0;
  for (unsigned int d = 0; d < dim; ++d)
    result = std::hypot(result, edge[d]);
  return result;
}

/** Cells one by one: an edge is too short where a corner of its cell is round-off. */
void check_cells(const Scene<2> &scene, const std::string &entry)
{
  const CellFlaw worst = worst_cell(*scene.geometry.mesh);
  if (worst.is_folded)
    reject(scene, "Geometry", entry,
           "makes a cell that folds over itself at " + to_string(worst.at) +
               "; take more cells along curves, or straight edges that keep away from them");
  if (worst.angle > 179.9)
    reject(scene, "Geometry", entry,
           "makes a cell with an angle of " + to_string(worst.angle) + " degrees at " +
               to_string(worst.at) +
               ": two of its edges are one line or one smooth curve; end a cell there, as by "
               "another vertex inside");
}

void check_angles(const Scene<2> &scene, const std::string &entry)
{
  if (scene.geometry.has_mesh())
    return check_cells(scene, entry);
  for (const Corner &corner : corners_of(scene.geometry))
    if (corner.degrees < 0.1 || corner.degrees > 179.9)
      reject(scene, "Geometry", entry,
             "has an angle of " + to_string(corner.degrees) + " degrees at " +
                 to_string(corner.at) +
                 "; give a quadrilateral with angles between 0.1 and 179.9 degrees");
}

void check_angles(const Scene<3> &, const std::string &)
{
}

double shortest_edge(const CoarseMesh &mesh)
{
  double shortest = std::numeric_limits<double>::max();
  for (const CoarseMesh::Cell &cell : mesh.cells)
    for (unsigned int v = 0; v < 4; ++v)
      shortest = std::min(shortest, length(mesh.vertices[cell.vertices[(v + 1) % 4]] -
                                           mesh.vertices[cell.vertices[v]]));
  return shortest;
}

double shortest_edge(const HexahedralMesh &mesh)
{
  double shortest = std::numeric_limits<double>::max();
  for (const auto &cell : mesh.hexahedra)
    for (unsigned int l = 0; l < GeometryInfo<3>::lines_per_cell; ++l)
      shortest = std::min(shortest,
                          length(mesh.corners[cell[GeometryInfo<3>::line_to_cell_vertices(l, 1)]] -
                                 mesh.corners[cell[GeometryInfo<3>::line_to_cell_vertices(l, 0)]]));
  return shortest;
}

/** Lengths that can be squared, edges that are more than round-off, corners that are corners. */
template <int dim>
void check_lengths(const Scene<dim> &scene, const std::string &entry)
{
  const Corners<dim> &corners = scene.geometry.corners;
  double farthest = 0, shortest = std::numeric_limits<double>::max();
  for (const Point<dim> &corner : corners)
    for (unsigned int d = 0; d < dim; ++d)
      farthest = std::max(farthest, std::abs(corner[d]));
  for (unsigned int l = 0; l < GeometryInfo<dim>::lines_per_cell; ++l)
    shortest = std::min(shortest, length(corners[GeometryInfo<dim>::line_to_cell_vertices(l, 1)] -
                                         corners[GeometryInfo<dim>::line_to_cell_vertices(l, 0)]));
  if constexpr (dim == 3)
    shortest = scene.geometry.mesh ? shortest_edge(*hexahedra_of(scene.geometry)) : shortest;
  else if (scene.geometry.mesh)
    shortest = shortest_edge(*scene.geometry.mesh);
  if (!(farthest <= largest_magnitude) || !(shortest >= smallest_magnitude))
    reject(scene, "Geometry", entry,
           "has lengths from " + to_string(shortest) + " to " + to_string(farthest) +
               " and they must lie between 1e-100 and 1e100; choose another unit");
  if (shortest < 1e-10 * farthest)
    reject(scene, "Geometry", entry,
           "has an edge of length " + to_string(shortest) + " and coordinates up to " +
               to_string(farthest) +
               ", which round-off blurs; move the body towards "
               "the origin");
  check_angles(scene, entry);
}

template <int dim>
void check_grading(const Scene<dim> &scene)
{
  const Geometry<dim> &geometry = scene.geometry;
  if (geometry.grading_levels > 0 && geometry.graded_towards.empty())
    reject(scene, "Geometry", "Grading levels",
           std::string("has no point to grade to; set Graded towards = ") +
               (dim == 2 ? "x, y" : "x, y, z") + " or remove it");
  for (const Point<dim> &point : geometry.graded_towards)
    if (!geometry.contains(point))
      reject(scene, "Geometry", "Graded towards",
             "has the point " + to_string(point) + " outside the body; name points of the body");
}
/** Corners, subdivisions and grading make a mesh. */
template <int dim>
void check_geometry(const Scene<dim> &scene)
{
  if (scene.geometry.shape == Shape::bodies)
    return; // each has been checked by itself
  const ShapeKind<dim> *const kind = find_shape<dim>(scene.geometry.shape);
  if (kind == nullptr)
    reject(scene, "Geometry", "Shape",
           "is offered in the plane alone; take box_corners() or a mesh of hexahedra");
  if (kind->flaw)
    if (const auto flaw = kind->flaw(scene.geometry.corners))
      reject(scene, "Geometry", flaw->entry, flaw->problem, flaw->value);
  check_lengths(scene, kind->size_entry);
  double cells = scene.geometry.has_mesh() ? scene.geometry.n_cells() : 1;
  std::string shown;
  for (const unsigned int n : scene.geometry.subdivisions)
  {
    cells *= scene.geometry.has_mesh() ? 1 : n;
    shown += (shown.empty() ? "" : ", ") + std::to_string(n);
  }
  if (cells == 0)
    reject(scene, "Geometry", "Subdivisions",
           std::string("makes no cells; give ") + (dim == 2 ? "two" : "three") +
               " positive integers",
           shown);
  if (cells > 1e6)
    reject(scene, "Geometry", "Subdivisions", too_many_cells, shown);
  check_grading(scene);
}

/** Each material is elastic, and it is said which is where. */
template <int dim>
void check_materials(const Scene<dim> &scene)
{
  const std::string number = std::to_string(scene.materials.size());
  if (scene.materials.empty())
    fail(printable(scene.origin()), "Material", "is missing; give at least one");
  if (scene.materials.size() > 1 && !scene.has_material_places())
    fail(printable(scene.origin()), "Material",
         "says nowhere which of " + number + " is where; set material_at or keep one");
  for (const Material &material : scene.materials)
    if (const auto flaw = material.flaw())
      reject(scene, section_of_material(material.name), flaw->entry, flaw->problem, flaw->value);
}

} // namespace

template <int dim>
void check_body(const Scene<dim> &scene)
{
  check_geometry(scene);
  check_materials(scene);
}

template void check_body(const Scene<2> &);
template void check_body(const Scene<3> &);
} // namespace hpvi
