// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/cell_map.h>

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

template <int dim>
CellMap<dim>::CellMap(const Vertices &vertices) : corners(vertices), affine(false)
{
  Point<dim> centre;
  for (unsigned int d = 0; d < dim; ++d)
    centre[d] = 0.5;
  constant_jacobian = jacobian(centre);
  // Far from the origin vertices are rounded more coarsely.
  double coordinates = 0;
  for (const Point<dim> &corner : corners)
    coordinates += corner.norm();
  affine = hessian(centre).norm() <= 1e-12 * constant_jacobian.norm() +
                                         2 * std::numeric_limits<double>::epsilon() * coordinates;
}

template <int dim>
const typename CellMap<dim>::Vertices &CellMap<dim>::vertices() const
{
  return corners;
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
    std::array<unsigned int, dim> order{};
    order[j] = 1;
    for (unsigned int v = 0; v < corners.size(); ++v)
      for (unsigned int i = 0; i < dim; ++i)
        J[i][j] += vertex_shape<dim>(v, reference, order) * (corners[v][i] - corners[0][i]);
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
      for (unsigned int v = 0; v < corners.size(); ++v)
        for (unsigned int i = 0; i < dim; ++i)
          H[i][j][k] += vertex_shape<dim>(v, reference, order) * (corners[v][i] - corners[0][i]);
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
double CellMap<dim>::face_measure(const unsigned int face_no, const Point<dim> &reference) const
{
  return area_vector(*this, face_no, reference).norm();
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
