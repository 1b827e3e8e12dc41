// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/hexahedral_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

const HexahedralMesh *hexahedra_of(const Geometry<3> &geometry)
{
  return static_cast<const HexahedralMesh *>(geometry.mesh.get());
}

Corners<3> HexahedralMesh::corners_of(const unsigned int cell) const
{
  Corners<3> result;
  for (unsigned int v = 0; v < n_corners; ++v)
    result[v] = corners[hexahedra[cell][v]];
  return result;
}

Side<3>::Piece HexahedralMesh::corners_of(const Face &face) const
{
  Side<3>::Piece result;
  for (unsigned int v = 0; v < 4; ++v)
    result[v] = corners[face.vertices[v]];
  return result;
}

namespace
{
/** Lagrange's quadratics at 0, 1/2 and 1, or a derivative of them. */
std::array<double, 3> quadratics(const double x, const unsigned int order)
{
  if (order == 0)
    return {{(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)}};
  if (order == 1)
    return {{4 * x - 3, 4 - 8 * x, 4 * x - 1}};
  return {{4, -8, 4}};
}
} // namespace

Tensor<1, 3> triquadratic(const std::array<Tensor<1, 3>, 27> &a, const Point<3> &xi,
                          const std::array<unsigned int, 3> &order)
{
  std::array<std::array<double, 3>, 3> of_axis;
  for (unsigned int d = 0; d < 3; ++d)
    of_axis[d] = quadratics(xi[d], order[d]);
  Tensor<1, 3> result;
  for (unsigned int k = 0; k < a.size(); ++k)
    result += of_axis[0][k % 3] * of_axis[1][k / 3 % 3] * of_axis[2][k / 9] * a[k];
  return result;
}

std::optional<Point<3>> folded_at(const HexahedronNodes &nodes, const double least)
{
  std::array<Tensor<1, 3>, 27> from_first;
  for (unsigned int k = 0; k < nodes.size(); ++k)
    from_first[k] = nodes[k] - nodes[0];
  for (unsigned int k = 0; k < 125; ++k)
  {
    const Point<3> xi(k % 5 / 4., k / 5 % 5 / 4., k / 25 / 4.);
    const Tensor<1, 3> a = triquadratic(from_first, xi, {{1, 0, 0}}),
                       b = triquadratic(from_first, xi, {{0, 1, 0}}),
                       c = triquadratic(from_first, xi, {{0, 0, 1}});
    if (!(cross_product_3d(a, b) * c > least * a.norm() * b.norm() * c.norm()))
      return nodes[0] + triquadratic(from_first, xi);
  }
  return std::nullopt;
}

Point<3> centre_of(const Corners<3> &cell)
{
  Point<3> result;
  for (const Point<3> &corner : cell)
    result += corner / double(cell.size());
  return result;
}

namespace
{
/** Half the product of the diagonals: the normal times the area. */
Tensor<1, 3> area_vector(const Side<3>::Piece &piece)
{
  return 0.5 * cross_product_3d(piece[3] - piece[0], piece[2] - piece[1]);
}

double distance(const Point<3> &a, const Point<3> &b, const Point<3> &x)
{
  const Tensor<1, 3> way = b - a;
  const double s = std::clamp((x - a) * way / way.norm_square(), 0., 1.);
  return (a + s * way).distance(x);
}
} // namespace

Tensor<1, 3> normal_of(const Side<3>::Piece &piece)
{
  const Tensor<1, 3> n = area_vector(piece);
  return n / n.norm();
}

double area_of(const Side<3>::Piece &piece)
{
  return area_vector(piece).norm();
}

double distance(const Side<3>::Piece &piece, const Point<3> &x)
{
  const Tensor<1, 3> n = normal_of(piece);
  double beside = std::numeric_limits<double>::max();
  bool is_above = true;
  constexpr std::array<unsigned int, 5> around{{0, 1, 3, 2, 0}};
  for (unsigned int k = 0; k < 4; ++k)
  {
    const Point<3> &a = piece[around[k]], &b = piece[around[k + 1]];
    is_above = is_above && cross_product_3d(b - a, x - a) * n >= 0;
    beside = std::min(beside, distance(a, b, x));
  }
  return is_above ? std::abs((x - piece[0]) * n) : beside;
}

std::vector<Side<3>> sides_of_mesh(const HexahedralMesh &mesh)
{
  std::vector<Side<3>> sides(mesh.boundaries.size());
  for (const HexahedralMesh::Face &face : mesh.faces)
    sides[face.boundary].pieces.push_back(mesh.corners_of(face));
  for (Side<3> &side : sides)
  {
    const Tensor<1, 3> n = normal_of(side.pieces.front());
    if (std::all_of(side.pieces.begin(), side.pieces.end(),
                    [&](const Side<3>::Piece &piece)
                    { return (normal_of(piece) - n).norm() < 1e-8; }))
      side.outward = n;
  }
  return sides;
}

bool contains(const Corners<3> &cell, const Point<3> &x, const double hair)
{
  for (unsigned int f = 0; f < GeometryInfo<3>::faces_per_cell; ++f)
  {
    Side<3>::Piece face;
    for (unsigned int v = 0; v < face.size(); ++v)
      face[v] = cell[GeometryInfo<3>::face_to_cell_vertices(f, v)];
    const Tensor<1, 3> n = normal_of(face);
    const double inside = (centre_of(cell) - face[0]) * n;
    if ((x - face[0]) * n * (inside < 0 ? 1. : -1.) > hair)
      return false;
  }
  return true;
}

bool contains(const HexahedralMesh &mesh, const Point<3> &x, const double hair)
{
  for (unsigned int c = 0; c < mesh.hexahedra.size(); ++c)
    if (contains(mesh.corners_of(c), x, hair))
      return true;
  return false;
}

std::vector<Point<3>> sample(const HexahedralMesh &mesh)
{
  const unsigned int n_cells = mesh.hexahedra.size(), n = n_cells > 64 ? 1 : n_cells > 8 ? 2 : 6;
  std::vector<Point<3>> points;
  Geometry<3> cell;
  for (std::size_t c = 0; c < n_cells; c += 1 + n_cells / 4000)
  {
    cell.corners = mesh.corners_of(c);
    for (unsigned int k = 0; k < (n + 1) * (n + 1) * (n + 1); ++k)
      points.push_back(
          cell.point(Point<3>(double(k % (n + 1)) / n, double(k / (n + 1) % (n + 1)) / n,
                              double(k / (n + 1) / (n + 1)) / n)));
  }
  return points;
}

template <int dim>
std::vector<Tensor<1, dim>> normals_at(const Side<dim> &side, const Point<dim> &x)
{
  if constexpr (dim == 3)
  {
    if (side.is_flat())
      return {side.outward};
    std::vector<Tensor<1, 3>> result;
    for (const Side<3>::Piece &piece : side.pieces)
    {
      const Tensor<1, 3> n = normal_of(piece);
      if (distance(piece, x) <= 1e-9 * std::sqrt(area_of(piece)) &&
          std::none_of(result.begin(), result.end(),
                       [&](const Tensor<1, 3> &known) { return (known - n).norm() < 1e-8; }))
        result.push_back(n);
    }
    return result;
  }
  else
    return {side.normal(x)};
}

template std::vector<Tensor<1, 2>> normals_at(const Side<2> &, const Point<2> &);
template std::vector<Tensor<1, 3>> normals_at(const Side<3> &, const Point<3> &);
} // namespace hpvi
