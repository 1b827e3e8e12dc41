// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <hpvi/base/inverse_map.h>
#include <hpvi/base/text.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/curved_edges.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
std::vector<unsigned int> repetitions(const Geometry<dim> &geometry)
{
  std::vector<unsigned int> result;
  for (unsigned int d = 0; d < dim; ++d)
    result.push_back(geometry.n_cells(d));
  return result;
}

/** Where the vertices of an equidistant grid in the unit cube are wanted. */
template <int dim>
class GridLines
{
public:
  explicit GridLines(const Geometry<dim> &geometry) : geometry(geometry)
  {
    for (unsigned int d = 0; d < dim; ++d)
      lines[d] = geometry.grid_lines(d);
  }

  Point<dim> operator()(const Point<dim> &equidistant) const
  {
    Point<dim> unit;
    for (unsigned int d = 0; d < dim; ++d)
      unit[d] = lines[d][std::lround(equidistant[d] * (lines[d].size() - 1))];
    return geometry.point(unit);
  }

private:
  const Geometry<dim> &geometry;
  std::array<std::vector<double>, dim> lines;
};

template <int dim>
void set_parts(const Scene<dim> &scene, Triangulation<dim> &triangulation)
{
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (scene.has_parts() && face->at_boundary())
        face->set_boundary_id(
            boundary_at(scene, face->boundary_id(), face->center(/*respect_manifold=*/true)));
}

/** Between curved edges the mean of the vertices may lie outside. */
template <int dim>
Point<dim> centre_of(const typename Triangulation<dim>::cell_iterator &cell)
{
  Point<dim> middle;
  for (unsigned int d = 0; d < dim; ++d)
    middle[d] = 0.5;
  const CellMap<dim> map = map_of<dim>(cell);
  return map.is_curved() ? map.point(middle) : cell->center();
}

/** deal.II colours the cells of a box by octants; a scene says itself what they are made of. */
template <int dim>
void set_materials(const Scene<dim> &scene, Triangulation<dim> &triangulation)
{
  for (const auto &cell : triangulation.active_cell_iterators())
  {
    const types::material_id id =
        scene.material_of_coarse_cell(centre_of<dim>(cell), cell->index());
    if (id >= scene.materials.size())
      throw InputError(scene.origin() + ": material_at gives " + std::to_string(id) + " at " +
                       to_string(cell->center()) + ", but there are " +
                       std::to_string(scene.materials.size()) +
                       " materials; number them from 0, or add one");
    cell->set_material_id(id);
  }
}

/** A point on a face belongs to both sides; the tolerance covers round-off of rotations. */
template <int dim>
bool touches(const typename Triangulation<dim>::cell_iterator &cell, const Point<dim> &point)
{
  if constexpr (dim == 2)
    if (const auto blends = blends_of(cell))
    {
      // Where a point is inside matters less than which vertices and curves it lies on.
      for (const unsigned int v : cell->vertex_indices())
        if (cell->vertex(v).distance(point) <= 1e-10 * cell->diameter())
          return true;
      for (const EdgeBlend &blend : *blends)
        if (blend && blend.curve().point(blend.curve().nearest(point)).distance(point) <=
                         1e-8 * cell->diameter())
          return true;
    }
  if constexpr (dim == 3)
  {
    const CellMap<3> map = map_of<3>(cell);
    if (map.is_curved())
      return inverse_of(map, point, 1e-8).has_value();
    if (!map.is_affine())
      return contains(map.vertices(), point, 1e-8 * map.shortest_edge());
  }
  return cell->bounding_box().point_inside(point, 1e-10) &&
         GeometryInfo<dim>::distance_to_unit_cell(
             cell->real_to_unit_cell_affine_approximation(point)) < 1e-8;
}

/** Each of several bodies towards points of its own. */
template <int dim>
void grade_towards_points(const Geometry<dim> &geometry, Triangulation<dim> &triangulation)
{
  const std::vector<Body<dim>> bodies =
      geometry.bodies.empty()
          ? std::vector<Body<dim>>{{"", {}, geometry.graded_towards, geometry.grading_levels}}
          : geometry.bodies;
  unsigned int n_levels = 0;
  for (const Body<dim> &body : bodies)
    n_levels = std::max(n_levels, body.grading_levels);
  for (unsigned int level = 0; level < n_levels; ++level)
  {
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        if (const Body<dim> &body = bodies[body_of<dim>(geometry, cell)];
            level < body.grading_levels)
          for (const Point<dim> &point : body.graded_towards)
            if (touches<dim>(cell, point))
              cell->set_refine_flag();
    triangulation.execute_coarsening_and_refinement();
  }
}
} // namespace

namespace
{
template <int dim>
void make_grid(const Geometry<dim> &geometry, Triangulation<dim> &triangulation)
{
  constexpr unsigned int last = GeometryInfo<dim>::vertices_per_cell - 1;
  const bool is_cut = std::any_of(geometry.cuts.begin(), geometry.cuts.end(),
                                  [](const auto &lines) { return !lines.empty(); });
  if (geometry.shape == Shape::box && !is_cut)
    GridGenerator::subdivided_hyper_rectangle(triangulation, repetitions(geometry),
                                              geometry.corners[0], geometry.corners[last],
                                              /*colorize=*/true);
  else
  {
    Point<dim> one;
    for (unsigned int d = 0; d < dim; ++d)
      one[d] = 1.;
    GridGenerator::subdivided_hyper_rectangle(triangulation, repetitions(geometry), Point<dim>(),
                                              one, /*colorize=*/true);
    if (is_cut)
      GridTools::transform(GridLines<dim>(geometry), triangulation);
    else
      GridTools::transform([&](const Point<dim> &x) { return geometry.point(x); }, triangulation);
  }
}

/** Vertices and cells keep their numbers. */
void make_cells(const CoarseMesh &mesh, Triangulation<2> &triangulation)
{
  std::vector<CellData<2>> cells;
  for (const CoarseMesh::Cell &cell : mesh.cells)
  {
    const auto &v = cell.vertices;
    cells.emplace_back();
    cells.back().vertices = {v[0], v[1], v[3], v[2]}; // deal.II counts line by line
  }
  SubCellData boundary;
  for (const CoarseMesh::Edge &edge : mesh.edges)
    if (edge.boundary != CoarseMesh::inside)
    {
      boundary.boundary_lines.emplace_back();
      boundary.boundary_lines.back().vertices = {edge.vertices[0], edge.vertices[1]};
      boundary.boundary_lines.back().boundary_id = edge.boundary;
    }
  GridTools::consistently_order_cells(cells);
  triangulation.create_triangulation(mesh.vertices, cells, boundary);
  attach_curves(mesh, triangulation);
}

/** Where curved_map() has them: deal.II puts new vertices halfway between old ones. */
void place_vertices(Triangulation<3> &triangulation)
{
  for (const auto &cell : triangulation.cell_iterators())
    if (cell->level() > 0 && cell->manifold_id() != numbers::flat_manifold_id)
    {
      const CellMap<3> map = curved_map(cell);
      for (const unsigned int v : cell->vertex_indices())
        cell->vertex(v) = map.vertices()[v];
    }
}

void bend_cells(const HexahedralMesh &mesh, Triangulation<3> &triangulation)
{
  types::manifold_id id = 0;
  for (const auto &cell : triangulation.cell_iterators_on_level(0))
    if (const auto bent = mesh.bent.find(cell->index()); bent != mesh.bent.end())
    {
      const auto corners = mesh.corners_of(cell->index());
      const auto node = [&, &nodes = bent->second](const Point<3> &xi)
      { return nodes[std::lround(2 * xi[0] + 6 * xi[1] + 18 * xi[2])]; };
      triangulation.set_manifold(
          id, HexahedronManifold(CellMap<3>(corners, departures_of(corners, node))));
      cell->set_manifold_id(id++);
    }
  if (id > 0)
    triangulation.signals.post_refinement.connect([&triangulation]()
                                                  { place_vertices(triangulation); });
}

/** Likewise: the reader has put corners in the order that deal.II wants. */
void make_cells(const HexahedralMesh &mesh, Triangulation<3> &triangulation)
{
  std::vector<CellData<3>> cells;
  for (const auto &corners : mesh.hexahedra)
  {
    cells.emplace_back();
    cells.back().vertices.assign(corners.begin(), corners.end());
  }
  SubCellData boundary;
  for (const HexahedralMesh::Face &face : mesh.faces)
  {
    boundary.boundary_quads.emplace_back();
    boundary.boundary_quads.back().vertices.assign(face.vertices.begin(), face.vertices.end());
    boundary.boundary_quads.back().boundary_id = face.boundary;
  }
  triangulation.create_triangulation(mesh.corners, cells, boundary);
  bend_cells(mesh, triangulation);
}
} // namespace

template <int dim>
unsigned int body_of(const Geometry<dim> &geometry, typename Triangulation<dim>::cell_iterator cell)
{
  if (geometry.bodies.empty())
    return 0;
  while (cell->level() > 0)
    cell = cell->parent();
  return geometry.mesh->cells[cell->index()].body;
}

template <int dim>
void make_mesh(const Scene<dim> &scene, Triangulation<dim> &triangulation)
{
  const Geometry<dim> &geometry = scene.geometry;
  if constexpr (dim == 2)
    if (geometry.mesh)
      make_cells(*geometry.mesh, triangulation);
  if constexpr (dim == 3)
    if (geometry.mesh)
      make_cells(*hexahedra_of(geometry), triangulation);
  if (!geometry.mesh)
    make_grid(geometry, triangulation);
  // Boundary conditions are looked up by the ids of faces, which refinement hands on.
  AssertThrow(triangulation.get_boundary_ids().back() < scene.boundaries.size(),
              ExcMessage("The scene has no boundary of the number that a face carries."));
  set_parts(scene, triangulation);
  set_materials(scene, triangulation);
  grade_towards_points(geometry, triangulation);
}

bool Refinement::is_empty(const Degrees &old_degrees) const
{
  return degrees == old_degrees && std::find(bisect.begin(), bisect.end(), true) == bisect.end();
}

MeshMarks::MeshMarks(const Refinement &refinement, const Degrees &degrees)
    : n_cells(degrees.size()), then(refinement.then)
{
  for (unsigned int cell = 0; cell < n_cells; ++cell)
    if (refinement.bisect[cell])
      changed.emplace_back(cell, 0);
    else if (refinement.degrees[cell] != degrees[cell])
      changed.emplace_back(cell, refinement.degrees[cell]);
}

bool MeshMarks::fits(const Degrees &degrees) const
{
  return n_cells == degrees.size() && (changed.empty() || changed.back().first < n_cells);
}

Refinement MeshMarks::refinement(const Degrees &degrees) const
{
  Refinement result{std::vector<bool>(degrees.size()), degrees, then};
  for (const auto &[cell, degree] : changed)
    if (degree == 0)
      result.bisect[cell] = true;
    else
      result.degrees[cell] = degree;
  return result;
}

template <int dim>
Degrees refine_mesh(Triangulation<dim> &triangulation, const Degrees &degrees,
                    const Refinement &refinement)
{
  // The user index of a cell stays with it when it becomes a parent; a new child has none.
  for (const auto &cell : triangulation.active_cell_iterators())
  {
    cell->set_user_index(cell->active_cell_index() + 1);
    if (cell->is_locally_owned() && refinement.bisect[cell->active_cell_index()])
      cell->set_refine_flag();
  }
  triangulation.execute_coarsening_and_refinement();

  Degrees new_degrees(triangulation.n_active_cells());
  for (const auto &cell : triangulation.active_cell_iterators())
    new_degrees[cell->active_cell_index()] = cell->user_index() != 0
                                                 ? refinement.degrees[cell->user_index() - 1]
                                                 : degrees[cell->parent()->user_index() - 1];
  set_edge_degrees(triangulation, new_degrees);
  for (const MeshMarks &marks : refinement.then)
  {
    AssertThrow(marks.fits(new_degrees), ExcMessage("The marks are those of another mesh."));
    new_degrees = refine_mesh(triangulation, new_degrees, marks.refinement(new_degrees));
  }
  return new_degrees;
}

template unsigned int body_of(const Geometry<2> &, Triangulation<2>::cell_iterator);
template unsigned int body_of(const Geometry<3> &, Triangulation<3>::cell_iterator);
template void make_mesh(const Scene<2> &, Triangulation<2> &);
template void make_mesh(const Scene<3> &, Triangulation<3> &);
template Degrees refine_mesh(Triangulation<2> &, const Degrees &, const Refinement &);
} // namespace hpvi
