// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace hpvi
{
using namespace dealii;

std::vector<std::string> boundary_names(const int dim)
{
  std::vector<std::string> names = {"left", "right", "bottom", "top", "front", "back"};
  names.resize(2 * dim);
  return names;
}

template <int dim>
Corners<dim> box_corners(const Point<dim> &lower, const Point<dim> &upper)
{
  Corners<dim> corners;
  for (unsigned int v = 0; v < corners.size(); ++v)
    for (unsigned int d = 0; d < dim; ++d)
      corners[v][d] = ((v >> d) & 1u) ? upper[d] : lower[d];
  return corners;
}

Corners<2> quadrilateral_corners(const std::array<Point<2>, 4> &around)
{
  return {{around[0], around[1], around[3], around[2]}};
}

template <int dim>
Geometry<dim>::Geometry()
{
  Point<dim> upper;
  for (unsigned int d = 0; d < dim; ++d)
    upper[d] = 1.;
  corners = box_corners(Point<dim>(), upper);
  subdivisions.fill(1);
}

template <int dim>
bool Geometry<dim>::has_mesh() const
{
  return bool(mesh);
}

template <int dim>
bool Geometry<dim>::has_curves() const
{
  return mesh && std::any_of(mesh->edges.begin(), mesh->edges.end(),
                             [](const CoarseMesh::Edge &edge) { return bool(edge.curve); });
}

template <int dim>
std::vector<std::string> Geometry<dim>::boundary_names() const
{
  return mesh ? mesh->boundaries : hpvi::boundary_names(dim);
}

template <int dim>
double Geometry<dim>::n_cells() const
{
  double result = mesh ? mesh->cells.size() : 1.;
  for (unsigned int d = 0; d < dim && !mesh; ++d)
    result *= n_cells(d);
  return result;
}

template <int dim>
Point<dim> Geometry<dim>::point(const Point<dim> &unit) const
{
  // One direction after the other, from the nearer end: a side along an axis stays there to the last bit.
  Corners<dim> between = corners;
  for (unsigned int d = dim, n = corners.size(); d-- > 0;)
  {
    n /= 2;
    for (unsigned int v = 0; v < n; ++v)
      if (const Tensor<1, dim> across = between[v + n] - between[v]; unit[d] < 0.5)
        between[v] += unit[d] * across;
      else
        between[v] = between[v + n] - (1. - unit[d]) * across;
  }
  return between[0];
}

template <int dim>
unsigned int Geometry<dim>::body_of_side(const unsigned int side) const
{
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (std::find(bodies[b].sides.begin(), bodies[b].sides.end(), side) != bodies[b].sides.end())
      return b;
  return 0;
}

template <int dim>
std::vector<double> Geometry<dim>::grid_lines(const unsigned int direction) const
{
  std::vector<double> lines(subdivisions[direction] + 1);
  for (unsigned int i = 0; i < lines.size(); ++i)
    lines[i] = double(i) / subdivisions[direction];
  lines.insert(lines.end(), cuts[direction].begin(), cuts[direction].end());
  std::sort(lines.begin(), lines.end());
  return lines;
}

template <int dim>
unsigned int Geometry<dim>::n_cells(const unsigned int direction) const
{
  return mesh ? static_cast<unsigned int>(std::ceil(dim == 2 ? std::sqrt(mesh->cells.size())
                                                             : std::cbrt(mesh->cells.size())))
              : subdivisions[direction] + cuts[direction].size();
}

namespace
{
bool has_affine_cells_in(const CoarseMesh &mesh)
{
  if (std::any_of(mesh.edges.begin(), mesh.edges.end(),
                  [](const CoarseMesh::Edge &edge) { return bool(edge.curve); }))
    return false;
  return std::all_of(mesh.cells.begin(), mesh.cells.end(),
                     [&](const CoarseMesh::Cell &cell)
                     {
                       std::array<Point<2>, 4> x;
                       for (unsigned int v = 0; v < 4; ++v)
                         x[v] = mesh.vertices[cell.vertices[v]];
                       return (x[0] - x[1] + (x[2] - x[3])).norm() <= 1e-12 * x[0].distance(x[2]);
                     });
}
} // namespace

template <int dim>
bool Geometry<dim>::has_affine_cells() const
{
  if (mesh)
    return dim == 2 && has_affine_cells_in(*mesh);
  double size = 0, skew = 0, coordinates = 0; // far from the origin these are rounded more coarsely
  for (unsigned int v = 0; v < corners.size(); ++v)
  {
    Tensor<1, dim> affine; // from corner 0
    for (unsigned int d = 0; d < dim; ++d)
      if (v >> d & 1u)
        affine += corners[1u << d] - corners[0];
    size = std::max(size, affine.norm());
    skew = std::max(skew, (corners[v] - corners[0] - affine).norm());
    coordinates += corners[v].norm();
  }
  return skew <= 1e-12 * size + 2 * std::numeric_limits<double>::epsilon() * coordinates;
}

template <int dim>
double Geometry<dim>::diameter() const
{
  double result = 0;
  for (unsigned int v = 0; v < corners.size(); ++v)
    for (unsigned int w = 0; w < v; ++w)
      result = std::max(result, corners[w].distance(corners[v]));
  return result;
}

template <int dim>
double Geometry<dim>::radius() const
{
  const Point<dim> middle = centre();
  double result = 0;
  for (const Point<dim> &corner : corners)
    result = std::max(result, corner.distance(middle));
  return result;
}

template <int dim>
Point<dim> Geometry<dim>::centre() const
{
  Point<dim> result;
  for (const Point<dim> &corner : corners)
    result += corner / double(corners.size());
  return result;
}

namespace
{
/** Not more than @p hair outside: by the winding of boundaries around @p x, each followed in short steps. */
bool is_inside(const std::vector<Side<2>> &sides, const Point<2> &x, const double hair)
{
  double winding = 0;
  for (const Side<2> &side : sides)
    for (unsigned int k = 0; k < side.pieces.size(); ++k)
    {
      if (side.distance(k, x) <= hair)
        return true;
      const unsigned int steps = side.curves.empty() || !side.curves[k] ? 1 : 32;
      for (unsigned int i = 0; i < steps; ++i)
      {
        const Tensor<1, 2> a = side.point(k, double(i) / steps) - x,
                           b = side.point(k, double(i + 1) / steps) - x;
        winding += std::atan2(a[0] * b[1] - a[1] * b[0], a * b);
      }
    }
  return winding > numbers::PI;
}
} // namespace

template <int dim>
bool Geometry<dim>::contains(const Point<dim> &x) const
{
  if constexpr (dim == 3)
    if (mesh)
      return hpvi::contains(*hexahedra_of(*this), x, on_body * radius());
  const std::vector<Side<dim>> sides = sides_of(*this);
  if constexpr (dim == 2)
    if (mesh)
      return is_inside(sides, x, on_body * radius());
  return std::all_of(sides.begin(), sides.end(),
                     [&](const Side<dim> &side)
                     { return side.outward * (x - side.pieces[0][0]) <= on_body * radius(); });
}

namespace
{
std::vector<Corner> corners_of_mesh(const Geometry<2> &geometry)
{
  std::map<unsigned int, std::array<Tensor<1, 2>, 2>> ways; // into a vertex and out of it
  const auto &vertices = geometry.mesh->vertices;
  for (const CoarseMesh::Edge &edge : geometry.mesh->edges)
    if (edge.boundary != CoarseMesh::inside)
      for (const unsigned int end : {0, 1})
        ways[edge.vertices[end]][1 - end] =
            edge.curve ? edge.curve.derivative(end)
                       : vertices[edge.vertices[1]] - vertices[edge.vertices[0]];
  std::vector<Corner> result;
  for (const auto &[vertex, way] : ways)
  {
    const double turn = std::atan2(way[0][0] * way[1][1] - way[0][1] * way[1][0], way[0] * way[1]);
    if (std::abs(turn) > 1e-6)
      result.push_back({vertices[vertex], 180 - turn * 180 / numbers::PI});
  }
  return result;
}
} // namespace

std::vector<Corner> corners_of(const Geometry<2> &geometry)
{
  if (geometry.mesh)
    return corners_of_mesh(geometry);
  std::vector<Corner> result(4);
  for (unsigned int c = 0; c < result.size(); ++c)
  {
    // Neighbours differ in one bit of the lexicographic number.
    const Tensor<1, 2> a = geometry.corners[c ^ 1u] - geometry.corners[c],
                       b = geometry.corners[c ^ 2u] - geometry.corners[c];
    result[c] = {geometry.corners[c],
                 std::atan2(std::abs(a[0] * b[1] - a[1] * b[0]), a * b) * 180. / numbers::PI};
  }
  return result;
}

namespace
{
/** The points of a regular grid in the unit cube, @p n cells in each direction, y or z fastest. */
template <int dim>
std::vector<Point<dim>> unit_grid(const unsigned int n)
{
  std::vector<Point<dim>> points(1);
  for (unsigned int d = 0; d < dim; ++d)
  {
    std::vector<Point<dim>> finer;
    for (Point<dim> point : points)
      for (unsigned int i = 0; i <= n; ++i)
      {
        point[d] = double(i) / n;
        finer.push_back(point);
      }
    points = finer;
  }
  return points;
}
} // namespace

namespace
{
/** Likewise in each cell, some hundred in all; of thousands of cells every so many. */
std::vector<Point<2>> sample_mesh(const CoarseMesh &mesh)
{
  const unsigned int n = mesh.cells.size() > 64 ? 2 : mesh.cells.size() > 16 ? 4 : 8;
  std::vector<Point<2>> points;
  const EdgeCurves curves(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); c += 1 + mesh.cells.size() / 4000)
  {
    const BlendedCell cell(curves, c);
    for (const Point<2> &unit : unit_grid<2>(n))
      points.push_back(cell.point(unit[0], unit[1]));
  }
  return points;
}
} // namespace

template <int dim>
std::vector<Point<dim>> sample_body(const Geometry<dim> &geometry)
{
  if constexpr (dim == 2)
    if (geometry.mesh)
      return sample_mesh(*geometry.mesh);
  if constexpr (dim == 3)
    if (geometry.mesh)
      return sample(*hexahedra_of(geometry));
  std::vector<Point<dim>> points = unit_grid<dim>(16);
  for (Point<dim> &point : points)
    point = geometry.point(point);
  return points;
}

template Corners<2> box_corners(const Point<2> &, const Point<2> &);
template Corners<3> box_corners(const Point<3> &, const Point<3> &);
template struct Geometry<2>;
template struct Geometry<3>;
template std::vector<Point<2>> sample_body(const Geometry<2> &);
template std::vector<Point<3>> sample_body(const Geometry<3> &);
} // namespace hpvi
