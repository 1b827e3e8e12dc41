// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/inverse_map.h>
#include <hpvi/base/quadratics.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <deal.II/base/quadrature_lib.h>

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

namespace
{
class QuadraticMap
{
public:
  explicit QuadraticMap(const HexahedronNodes &nodes) : first(nodes[0])
  {
    for (unsigned int k = 0; k < nodes.size(); ++k)
      from_first[k] = nodes[k] - first;
  }

  Point<3> point(const Point<3> &xi) const
  {
    return first + triquadratic(from_first, xi);
  }

  /** Its columns are the images of the axes. */
  Tensor<2, 3> jacobian(const Point<3> &xi) const
  {
    Tensor<2, 3> result;
    for (unsigned int d = 0; d < 3; ++d)
    {
      std::array<unsigned int, 3> order{};
      order[d] = 1;
      const Tensor<1, 3> column = triquadratic(from_first, xi, order);
      for (unsigned int c = 0; c < 3; ++c)
        result[c][d] = column[c];
    }
    return result;
  }

  double longest_edge() const ///< from above: the diameter
  {
    double result = 0;
    for (const Tensor<1, 3> &node : from_first)
      result = std::max(result, 2 * node.norm());
    return result;
  }

private:
  const Point<3> first;
  std::array<Tensor<1, 3>, 27> from_first; ///< far from the origin differences keep their digits
};
} // namespace

std::optional<Point<3>> folded_at(const HexahedronNodes &nodes, const double least)
{
  const QuadraticMap map(nodes);
  for (unsigned int k = 0; k < 125; ++k)
  {
    const Point<3> xi(k % 5 / 4., k / 5 % 5 / 4., k / 25 / 4.);
    const Tensor<2, 3> J = transpose(map.jacobian(xi));
    if (!(determinant(J) > least * J[0].norm() * J[1].norm() * J[2].norm()))
      return map.point(xi);
  }
  return std::nullopt;
}

CurvedFace HexahedralMesh::curve_of(const Face &face) const
{
  const auto cell = bent.find(face.cell);
  if (cell == bent.end())
    return {};
  const auto &own = hexahedra[face.cell];
  std::array<int, 3> place{}; // of vertices 0, 1 and 2 of the face among the 27 nodes
  for (unsigned int k = 0; k < 3; ++k)
  {
    const unsigned int v = std::find(own.begin(), own.end(), face.vertices[k]) - own.begin();
    place[k] = (v & 1) * 2 + (v >> 1 & 1) * 6 + (v >> 2) * 18;
  }
  CurvedFace::Nodes nodes;
  for (int k = 0; k < 9; ++k)
    nodes[k] = cell->second[place[0] + (k % 3) * (place[1] - place[0]) / 2 +
                            k / 3 * (place[2] - place[0]) / 2];
  return CurvedFace(nodes);
}

double area_of(const HexahedralMesh &mesh, const HexahedralMesh::Face &face)
{
  const CurvedFace curve = mesh.curve_of(face);
  return curve ? curve.area() : area_of(mesh.corners_of(face));
}

double volume_of(const HexahedralMesh &mesh, const unsigned int cell)
{
  const auto bent = mesh.bent.find(cell);
  if (bent == mesh.bent.end())
    return volume_of(mesh.corners_of(cell));
  const QuadraticMap map(bent->second);
  const QGauss<3> rule(3); // det J has the degree 5 along each axis
  double result = 0;
  for (unsigned int q = 0; q < rule.size(); ++q)
    result += rule.weight(q) * determinant(map.jacobian(rule.point(q)));
  return result;
}

double volume_of(const Corners<3> &cell)
{
  double result = 0;
  for (unsigned int f = 0; f < GeometryInfo<3>::faces_per_cell; ++f)
  {
    Side<3>::Piece face;
    for (unsigned int v = 0; v < face.size(); ++v)
      face[v] = cell[GeometryInfo<3>::face_to_cell_vertices(f, v)];
    result += area_of(face) * std::abs(normal_of(face) * (centre_of(cell) - face[0])) / 3;
  }
  return result;
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
  {
    sides[face.boundary].pieces.push_back(mesh.corners_of(face));
    sides[face.boundary].curves.push_back(mesh.curve_of(face));
  }
  for (Side<3> &side : sides)
  {
    const Tensor<1, 3> n = normal_of(side.pieces.front());
    bool is_flat = true;
    for (unsigned int k = 0; is_flat && k < side.pieces.size(); ++k)
      is_flat = (normal_of(side.pieces[k]) - n).norm() < 1e-8 &&
                (!side.curves[k] || side.curves[k].is_plane());
    if (is_flat)
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

bool contains(const HexahedronNodes &cell, const Point<3> &x, const double hair)
{
  const QuadraticMap map(cell);
  return inverse_of(map, x, hair / map.longest_edge()).has_value();
}

bool contains(const HexahedralMesh &mesh, const Point<3> &x, const double hair)
{
  for (unsigned int c = 0; c < mesh.hexahedra.size(); ++c)
    if (const auto bent = mesh.bent.find(c); bent == mesh.bent.end()
                                                 ? contains(mesh.corners_of(c), x, hair)
                                                 : contains(bent->second, x, hair))
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
    const auto bent = mesh.bent.find(c);
    for (unsigned int k = 0; k < (n + 1) * (n + 1) * (n + 1); ++k)
    {
      const Point<3> xi(double(k % (n + 1)) / n, double(k / (n + 1) % (n + 1)) / n,
                        double(k / (n + 1) / (n + 1)) / n);
      points.push_back(bent == mesh.bent.end() ? cell.point(xi)
                                               : QuadraticMap(bent->second).point(xi));
    }
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
    for (unsigned int k = 0; k < side.pieces.size(); ++k)
    {
      const double hair = 1e-9 * std::sqrt(area_of(side.pieces[k]));
      if (!side.box(k).point_inside(x) || side.distance(k, x) > hair)
        continue;
      const Tensor<1, 3> n = side.normal(k, x);
      if (std::none_of(result.begin(), result.end(),
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
