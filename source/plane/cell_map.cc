// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/plane/cell_map.h>

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
} // namespace

template <int dim>
CellMap<dim>::CellMap(const Vertices &vertices, std::shared_ptr<const EdgeBlends> blends)
    : corners(vertices), curved(std::move(blends)), affine(false)
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
  Assert(curved, ExcMessage("All edges of the cell are straight."));
  return *curved;
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
  if constexpr (dim == 2)
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
    if constexpr (dim == 2)
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
      if constexpr (dim == 2)
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
  if constexpr (dim == 2)
    if (curved && (*curved)[face_no])
    {
      const QGauss<1> gauss(12);
      double length = 0;
      for (unsigned int q = 0; q < gauss.size(); ++q)
        length +=
            gauss.weight(q) * face_measure(face_no, point_on_face<dim>(face_no, gauss.point(q)));
      return length;
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
  return *std::max_element(lengths.begin(), lengths.end());
}

template <int dim>
double CellMap<dim>::shortest_edge() const
{
  const auto lengths = edge_lengths<dim>(corners);
  return *std::min_element(lengths.begin(), lengths.end());
}

template class CellMap<2>;
template class CellMap<1>;
template class CellMap<3>;
} // namespace hpvi
