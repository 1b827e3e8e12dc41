// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Derivative of the d-linear shape function of vertex v, of the given order per direction. */
template <int dim>
double vertex_shape(const unsigned int v, const Point<dim> &xi,
                    const std::array<unsigned int, dim> &order)
{
  double product = 1.;
  for (unsigned int d = 0; d < dim; ++d)
  {
    const bool far = (v >> d) & 1;
    if (order[d] == 0)
      product *= far ? xi[d] : 1. - xi[d];
    else if (order[d] == 1)
      product *= far ? 1. : -1.;
    else
      return 0.;
  }
  return product;
}
} // namespace

namespace
{
/** What curved edges add to the map, of the given order per direction, at most 2 in all. */
Tensor<1, 2> departure(const EdgeBlends &blends, const Point<2> &xi,
                       const std::array<unsigned int, 2> &order)
{
  Tensor<1, 2> result;
  for (unsigned int f = 0; f < blends.size(); ++f)
  {
    const unsigned int across = f / 2, along = 1 - across;
    if (!blends[f] || order[across] > 1)
      continue;
    const double far = f % 2 ? 1. : -1., fading = order[across] == 1 ? far
                                                  : f % 2            ? xi[across]
                                                                     : 1. - xi[across];
    result += fading * blends[f](xi[along], order[along])[order[along]];
  }
  return result;
}

/** What the nodes of a hexahedron of second order add. */
Tensor<1, 3> departure(const QuadraticDepartures &nodes, const Point<3> &xi,
                       const std::array<unsigned int, 3> &order)
{
  return triquadratic(nodes, xi, order);
}

/** In one dimension nothing is curved. */
Tensor<1, 1> departure(const EdgeBlends &, const Point<1> &, const std::array<unsigned int, 1> &)
{
  return {};
}
} // namespace

template <int dim>
CellMap<dim>::CellMap(const Vertices &vertices, std::shared_ptr<const Bend> bend)
    : corners(vertices), curved(std::move(bend)), affine(false)
{
  Point<dim> centre;
  for (unsigned int d = 0; d < dim; ++d)
    centre[d] = 0.5;
  constant_jacobian = jacobian(centre);
  // Far from the origin vertices are rounded more coarsely.
  double coordinates = 0;
  for (const Point<dim> &corner : corners)
    coordinates += corner.norm();
  affine = !curved &&
           hessian(centre).norm() <= 1e-12 * constant_jacobian.norm() +
                                         2 * std::numeric_limits<double>::epsilon() * coordinates;
}

template <int dim>
const typename CellMap<dim>::Vertices &CellMap<dim>::vertices() const
{
  return corners;
}

template <int dim>
bool CellMap<dim>::is_curved() const
{
  return bool(curved);
}

template <int dim>
const EdgeBlends &CellMap<dim>::blends() const
{
  if constexpr (dim == 3)
  {
    static const EdgeBlends none; // faces bend, not edges by themselves
    return none;
  }
  else
  {
    Assert(curved, ExcMessage("All edges of the cell are straight."));
    return *curved;
  }
}

template <int dim>
bool CellMap<dim>::is_affine() const
{
  return affine;
}

template <int dim>
Point<dim> CellMap<dim>::point(const Point<dim> &reference) const
{
  Point<dim> x;
  for (unsigned int v = 0; v < corners.size(); ++v)
    x += vertex_shape<dim>(v, reference, {}) * corners[v];
  if (curved)
    x += departure(*curved, reference, {});
  return x;
}

// Derivatives are those of differences, which keep their digits far from the origin: a rectangle has no shear there.
template <int dim>
Tensor<2, dim> CellMap<dim>::jacobian(const Point<dim> &reference) const
{
  if (affine)
    return constant_jacobian;
  Tensor<2, dim> J;
  for (unsigned int j = 0; j < dim; ++j)
  {
    for (unsigned int v = 0; v < corners.size(); ++v)
      if (const unsigned int end = v | 1u << j; end != v) // an edge along axis j
      {
        double weight = 1;
        for (unsigned int d = 0; d < dim; ++d)
          if (d != j)
            weight *= v >> d & 1u ? reference[d] : 1 - reference[d];
        for (unsigned int i = 0; i < dim; ++i)
          J[i][j] += weight * (corners[end][i] - corners[v][i]);
      }
    if (curved)
    {
      std::array<unsigned int, dim> order{};
      order[j] = 1;
      const Tensor<1, dim> column = departure(*curved, reference, order);
      for (unsigned int i = 0; i < dim; ++i)
        J[i][j] += column[i];
    }
  }
  return J;
}

template <int dim>
Tensor<3, dim> CellMap<dim>::hessian(const Point<dim> &reference) const
{
  Tensor<3, dim> H;
  if (affine)
    return H;
  for (unsigned int j = 0; j < dim; ++j)
    for (unsigned int k = 0; k < dim; ++k)
    {
      std::array<unsigned int, dim> order{};
      ++order[j];
      ++order[k];
      for (unsigned int v = 1; v < corners.size(); ++v)
      {
        const double bend = vertex_shape<dim>(v, reference, order);
        for (unsigned int i = 0; i < dim; ++i)
          H[i][j][k] += bend * (corners[v][i] - corners[0][i]);
      }
      if (curved)
      {
        const Tensor<1, dim> column = departure(*curved, reference, order);
        for (unsigned int i = 0; i < dim; ++i)
          H[i][j][k] += column[i];
      }
    }
  return H;
}

namespace
{
/** n ds over ds of the reference face, from the images of its tangents, whose product points outwards. */
template <int dim>
Tensor<1, dim> area_vector(const CellMap<dim> &map, const unsigned int face_no,
                           const Point<dim> &reference)
{
  const Tensor<2, dim> J = map.jacobian(reference);
  const auto &tangents = GeometryInfo<dim>::unit_tangential_vectors[face_no];
  if constexpr (dim == 1)
    return GeometryInfo<dim>::unit_normal_vector[face_no];
  else if constexpr (dim == 2)
    return cross_product_2d(J * tangents[0]);
  else
    return cross_product_3d(J * tangents[0], J * tangents[1]);
}
} // namespace

template <int dim>
Tensor<1, dim> CellMap<dim>::normal(const unsigned int face_no, const Point<dim> &reference) const
{
  const Tensor<1, dim> n = area_vector(*this, face_no, reference);
  return n / n.norm();
}

template <int dim>
Tensor<1, dim> CellMap<dim>::curve_normal(const unsigned int face_no,
                                          const Point<dim> &reference) const
{
  if constexpr (dim == 2)
    if (curved && (*curved)[face_no])
    {
      const Tensor<1, dim> n =
          cross_product_2d((*curved)[face_no].curve().derivative(reference[1 - face_no / 2]));
      return (face_no == 1 || face_no == 2 ? 1. : -1.) / n.norm() * n;
    }
  return normal(face_no, reference);
}

template <int dim>
double CellMap<dim>::face_measure(const unsigned int face_no, const Point<dim> &reference) const
{
  return area_vector(*this, face_no, reference).norm();
}

template <int dim>
double CellMap<dim>::face_area(const unsigned int face_no) const
{
  Point<dim - 1> middle;
  for (unsigned int s = 0; s + 1 < dim; ++s)
    middle[s] = 0.5;
  bool is_bent = dim == 3 && curved;
  if constexpr (dim == 2)
    is_bent = curved && (*curved)[face_no];
  if (is_bent)
  {
    const QGauss<dim - 1> gauss(12);
    double area = 0;
    for (unsigned int q = 0; q < gauss.size(); ++q)
      area += gauss.weight(q) * face_measure(face_no, point_on_face<dim>(face_no, gauss.point(q)));
    return area;
  }
  return face_measure(face_no, point_on_face<dim>(face_no, middle));
}

namespace
{
template <int dim>
auto edge_lengths(const typename CellMap<dim>::Vertices &vertices)
{
  std::array<double, GeometryInfo<dim>::lines_per_cell> result;
  for (unsigned int line = 0; line < result.size(); ++line)
    result[line] = vertices[GeometryInfo<dim>::line_to_cell_vertices(line, 0)].distance(
        vertices[GeometryInfo<dim>::line_to_cell_vertices(line, 1)]);
  return result;
}
} // namespace

template <int dim>
double CellMap<dim>::longest_edge() const
{
  const auto lengths = edge_lengths<dim>(corners);
  double bulge = 0;
  if constexpr (dim == 3)
    for (unsigned int k = 0; curved && k < curved->size(); ++k)
      bulge = std::max(bulge, (*curved)[k].norm());
  return *std::max_element(lengths.begin(), lengths.end()) + 2 * bulge;
}

template <int dim>
double CellMap<dim>::shortest_edge() const
{
  const auto lengths = edge_lengths<dim>(corners);
  return *std::min_element(lengths.begin(), lengths.end());
}

namespace
{
/** Which part of the reference cell of its coarse cell a cell is the image of, from `origin` on. */
std::pair<Point<3>, double> part_of_coarse_cell(const Triangulation<3>::cell_iterator &cell)
{
  Point<3> origin;
  double size = 1;
  const CellId id = cell->id();
  for (const std::uint8_t child : id.get_child_indices())
  {
    size /= 2;
    for (unsigned int d = 0; d < 3; ++d)
      origin[d] += child >> d & 1 ? size : 0.;
  }
  return {origin, size};
}
} // namespace

CellMap<3> curved_map(const Triangulation<3>::cell_iterator &cell)
{
  const CellMap<3> &coarse = dynamic_cast<const HexahedronManifold &>(
                                 cell->get_triangulation().get_manifold(cell->manifold_id()))
                                 .map;
  if (cell->level() == 0)
    return coarse;
  const std::pair<Point<3>, double> part = part_of_coarse_cell(cell);
  const auto at = [&coarse, &part](const Point<3> &xi)
  { return coarse.point(part.first + part.second * xi); };
  CellMap<3>::Vertices vertices;
  for (const unsigned int v : GeometryInfo<3>::vertex_indices())
    vertices[v] = at(GeometryInfo<3>::unit_cell_vertex(v));
  return CellMap<3>(vertices, departures_of(vertices, at));
}

std::shared_ptr<const QuadraticDepartures>
departures_of(const CellMap<3>::Vertices &vertices,
              const std::function<Point<3>(const Point<3> &)> &node)
{
  const CellMap<3> straight(vertices);
  auto result = std::make_shared<QuadraticDepartures>();
  for (unsigned int k = 0; k < result->size(); ++k)
    if (const Point<3> xi(k % 3 / 2., k / 3 % 3 / 2., k / 9 / 2.);
        k % 3 == 1 || k / 3 % 3 == 1 || k / 9 == 1)
      (*result)[k] = node(xi) - straight.point(xi);
  return result;
}

HexahedronManifold::HexahedronManifold(const CellMap<3> &map) : map(map)
{
}

std::unique_ptr<Manifold<3>> HexahedronManifold::clone() const
{
  return std::make_unique<HexahedronManifold>(map);
}

template class CellMap<2>;
template class CellMap<1>;
template class CellMap<3>;
} // namespace hpvi
