// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/inverse_map.h>
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
/** The nodes of a face, x fastest along it; (1-0) x (3-0) points outwards. */
std::array<Point<3>, 9> nodes_of(const HexahedralMesh &mesh, const HexahedralMesh::Face &face)
{
  if (mesh.bent.count(face.cell) == 0)
  {
    const Side<3>::Piece p = mesh.corners_of(face);
    const auto between = [](const Point<3> &a, const Point<3> &b) { return a + (b - a) / 2.; };
    const Point<3> low = between(p[0], p[1]), high = between(p[2], p[3]);
    return {{p[0], low, p[1], between(p[0], p[2]), between(low, high), between(p[1], p[3]), p[2],
             high, p[3]}};
  }
  const HexahedronNodes &nodes = mesh.bent.at(face.cell);
  const auto &corners = mesh.hexahedra[face.cell];
  std::array<unsigned int, 3> place{}; // of corners 0, 1 and 2 of the face among the 27 nodes
  for (unsigned int k = 0; k < 3; ++k)
  {
    const unsigned int v =
        std::find(corners.begin(), corners.end(), face.vertices[k]) - corners.begin();
    place[k] = (v & 1) * 2 + (v >> 1 & 1) * 6 + (v >> 2) * 18;
  }
  std::array<Point<3>, 9> result;
  for (int k = 0; k < 9; ++k)
    result[k] = nodes[int(place[0]) + (k % 3) * (int(place[1]) - int(place[0])) / 2 +
                      k / 3 * (int(place[2]) - int(place[0])) / 2];
  return result;
}

/** Four, around its middle, of a face of a cell that is bent. */
std::vector<Side<3>::Piece> pieces_of(const HexahedralMesh &mesh, const HexahedralMesh::Face &face)
{
  if (mesh.bent.count(face.cell) == 0)
    return {mesh.corners_of(face)};
  const auto nodes = nodes_of(mesh, face);
  std::vector<Side<3>::Piece> result;
  for (const unsigned int k : {0, 1, 3, 4})
    result.push_back({{nodes[k], nodes[k + 1], nodes[k + 3], nodes[k + 4]}});
  return result;
}

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
/** At a point of a face with nodes x_k: `x - x_0` and its derivatives along both coordinates. */
struct OnFace
{
  OnFace(const std::array<Point<3>, 9> &nodes, const Point<2> &xi)
  {
    const auto a = quadratics(xi[0], 0), b = quadratics(xi[1], 0), da = quadratics(xi[0], 1),
               db = quadratics(xi[1], 1);
    for (unsigned int k = 1; k < 9; ++k)
    {
      const Tensor<1, 3> node = nodes[k] - nodes[0];
      from_first += a[k % 3] * b[k / 3] * node;
      along[0] += da[k % 3] * b[k / 3] * node;
      along[1] += a[k % 3] * db[k / 3] * node;
    }
  }

  Tensor<1, 3> area_vector() const ///< n ds over that of the unit square
  {
    return cross_product_3d(along[0], along[1]);
  }

  Tensor<1, 3> from_first;
  std::array<Tensor<1, 3>, 2> along;
};

/** Where a face is nearest to @p x, by the method of Gauss and Newton, which for points on it is Newton's. */
Point<2> nearest_on(const std::array<Point<3>, 9> &face, const Point<3> &x)
{
  Point<2> xi(0.5, 0.5);
  for (unsigned int step = 0; step < 30; ++step)
  {
    const OnFace here(face, xi);
    const Tensor<1, 3> rest = (x - face[0]) - here.from_first;
    Tensor<2, 2> normal;
    Tensor<1, 2> right;
    for (unsigned int a = 0; a < 2; ++a)
    {
      right[a] = here.along[a] * rest;
      for (unsigned int b = 0; b < 2; ++b)
        normal[a][b] = here.along[a] * here.along[b];
    }
    const Point<2> old = xi;
    const Tensor<1, 2> change = invert(normal) * right;
    for (unsigned int a = 0; a < 2; ++a)
      xi[a] = std::clamp(xi[a] + change[a], 0., 1.);
    if (xi.distance(old) < 1e-9) // Newton's next step would be its square
      break;
  }
  return xi;
}

/** A face is within the hull of its Bezier points, of which in each direction the middle is twice a node less the mean of its ends. */
std::vector<BoundingBox<3>> boxes_around(const std::vector<std::array<Point<3>, 9>> &faces)
{
  std::vector<BoundingBox<3>> result;
  for (const auto &nodes : faces)
  {
    std::vector<Point<3>> points(nodes.begin(), nodes.end());
    for (const auto &[along, across] : {std::pair(1, 3), {3, 1}})
      for (unsigned int line = 0; line < 3; ++line)
      {
        const unsigned int k = across * line;
        points[k + along] =
            points[k + along] +
            ((points[k + along] - points[k]) + (points[k + along] - points[k + 2 * along])) / 2.;
      }
    result.emplace_back(points);
    result.back().extend(1e-9 * nodes[0].distance(nodes[8]));
  }
  return result;
}

std::vector<std::array<Point<3>, 9>> faces_of(const HexahedralMesh &mesh,
                                              const unsigned int boundary)
{
  std::vector<std::array<Point<3>, 9>> result;
  for (const HexahedralMesh::Face &face : mesh.faces)
    if (face.boundary == boundary)
      result.push_back(nodes_of(mesh, face));
  return result;
}
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

double area_of(const HexahedralMesh &mesh, const HexahedralMesh::Face &face)
{
  if (mesh.bent.count(face.cell) == 0)
    return area_of(mesh.corners_of(face));
  const auto nodes = nodes_of(mesh, face);
  const QGauss<2> rule(8);
  double result = 0;
  for (unsigned int q = 0; q < rule.size(); ++q)
    result += rule.weight(q) * OnFace(nodes, rule.point(q)).area_vector().norm();
  return result;
}

bool is_plane(const HexahedralMesh &mesh, const HexahedralMesh::Face &face)
{
  const std::vector<Side<3>::Piece> pieces = pieces_of(mesh, face);
  const Tensor<1, 3> normal = normal_of(pieces.front());
  const double size = pieces.front()[0].distance(pieces.back()[3]);
  return std::all_of(pieces.begin(), pieces.end(),
                     [&](const Side<3>::Piece &piece)
                     {
                       return std::all_of(
                           piece.begin(), piece.end(),
                           [&](const Point<3> &x)
                           { return std::abs((x - pieces.front()[0]) * normal) <= 1e-8 * size; });
                     });
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
    for (const Side<3>::Piece &piece : pieces_of(mesh, face))
      sides[face.boundary].pieces.push_back(piece);
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

CurvedNormals::CurvedNormals(const HexahedralMesh &mesh, const unsigned int boundary)
    : faces(faces_of(mesh, boundary)), tree(boxes_around(faces))
{
}

Tensor<1, 3> CurvedNormals::operator()(const Point<3> &x) const
{
  const unsigned int nearest = tree.nearest(
      x, [&](const unsigned int k)
      { return (x - faces[k][0] - OnFace(faces[k], nearest_on(faces[k], x)).from_first).norm(); });
  const Tensor<1, 3> n = OnFace(faces[nearest], nearest_on(faces[nearest], x)).area_vector();
  return n / n.norm();
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
