// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/cell_map.h>
#include <hpvi/space/elastic_foundation.h>

#include <deal.II/base/quadrature_lib.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** By face of the unit cell, with @p n_points in each direction. */
template <int dim>
std::vector<ShapeTable<dim>> tables_of_faces(const unsigned int degree, const unsigned int n_points)
{
  const QGauss<dim - 1> rule(n_points);
  std::vector<ShapeTable<dim>> result;
  for (const unsigned int face : GeometryInfo<dim>::face_indices())
  {
    std::vector<Point<dim>> points;
    for (const Point<dim - 1> &point : rule.get_points())
      points.push_back(point_on_face<dim>(face, point));
    result.push_back(tabulate<dim>(degree, points, rule.get_weights(), false));
  }
  return result;
}

/** `k_n n n' + k_t (I - n n')` of two shape functions. */
template <int dim>
Tensor<2, dim> entry(const SpringsOfFace<dim> &springs, const unsigned int i, const unsigned int j)
{
  const double k_n = springs.along_normal(i, j), k_t = springs.along_face(i, j);
  return k_t * Tensor<2, dim>(unit_symmetric_tensor<dim>()) +
         (k_n - k_t) * outer_product(springs.normal, springs.normal);
}
} // namespace

template <int dim>
std::vector<Tensor<1, dim>> SpringsOfFace<dim>::forces(const CellField<dim> &u) const
{
  std::vector<Tensor<1, dim>> result(shapes.size());
  for (unsigned int i = 0; i < shapes.size(); ++i)
    for (unsigned int j = 0; j < shapes.size(); ++j)
      result[i] += entry(*this, i, j) * u[shapes[j]];
  return result;
}

// Constant springs meet polynomials of degree 2p: p + 1 points are exact. Others have three more.
template <int dim>
ElasticFoundation<dim>::ElasticFoundation(const Scene<dim> &scene, const BoxTables<dim> &tables)
    : scene(scene), tables(tables), has_springs(scene.has_springs())
{
  if (!has_springs)
    return;
  constant = tables_of_faces<dim>(tables.degree, tables.degree + 1);
  varying = tables_of_faces<dim>(tables.degree, tables.degree + 4);
}

template <int dim>
const Spring<dim> &ElasticFoundation<dim>::spring(const Cell &cell, const unsigned int face) const
{
  return scene.boundaries[cell->face(face)->boundary_id()].spring;
}

template <int dim>
bool ElasticFoundation<dim>::holds(const Cell &cell) const
{
  if (has_springs)
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face) && spring(cell, face))
        return true;
  return false;
}

template <int dim>
std::vector<SpringsOfFace<dim>> ElasticFoundation<dim>::below(const Cell &cell) const
{
  std::vector<SpringsOfFace<dim>> result;
  const CellMap<dim> map = map_of<dim>(cell);
  for (const unsigned int face : cell->face_indices())
  {
    if (!has_springs || !cell->at_boundary(face) || !spring(cell, face))
      continue;
    const Spring<dim> &own = spring(cell, face);
    SpringsOfFace<dim> springs;
    springs.boundary = cell->face(face)->boundary_id();
    for (unsigned int i = 0; i < tables.n_shapes; ++i)
      if (tables.fe.has_support_on_face(tables.numbers[i][0], face))
        springs.shapes.push_back(i);
    const ShapeTable<dim> &table = (own.varies() ? varying : constant)[face];
    const unsigned int n = springs.shapes.size();
    springs.normal = map.normal(face, table.points[0]);
    springs.along_normal.reinit(n, n);
    springs.along_face.reinit(n, n);
    for (unsigned int q = 0; q < table.points.size(); ++q)
    {
      const auto [k_n, k_t] = own.at(map.point(table.points[q]));
      const double ds = table.weights[q] * map.face_measure(face, table.points[q]);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          const double product =
              ds * table.values(q, springs.shapes[i]) * table.values(q, springs.shapes[j]);
          springs.along_normal(i, j) += k_n * product;
          springs.along_face(i, j) += k_t * product;
        }
    }
    result.push_back(std::move(springs));
  }
  return result;
}

template <int dim>
void ElasticFoundation<dim>::add_to(FullMatrix<double> &K, const Cell &cell) const
{
  for (const SpringsOfFace<dim> &springs : below(cell))
    for (unsigned int i = 0; i < springs.shapes.size(); ++i)
      for (unsigned int j = 0; j < springs.shapes.size(); ++j)
      {
        const Tensor<2, dim> k = entry(springs, i, j);
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            K(tables.numbers[springs.shapes[i]][c], tables.numbers[springs.shapes[j]][d]) +=
                k[c][d];
      }
}

template <int dim>
void ElasticFoundation<dim>::add_to_diagonal(std::vector<double> &diagonal, const Cell &cell) const
{
  for (const SpringsOfFace<dim> &springs : below(cell))
    for (unsigned int i = 0; i < springs.shapes.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        diagonal[tables.numbers[springs.shapes[i]][c]] += entry(springs, i, i)[c][c];
}

/** Shape functions add up to one. */
template <int dim>
Tensor<1, 2> ElasticFoundation<dim>::stiffness(const SpringsOfFace<dim> &springs)
{
  Tensor<1, 2> sum;
  for (unsigned int i = 0; i < springs.shapes.size(); ++i)
    for (unsigned int j = 0; j < springs.shapes.size(); ++j)
    {
      sum[0] += springs.along_normal(i, j);
      sum[1] += springs.along_face(i, j);
    }
  return sum;
}

template struct SpringsOfFace<2>;
template struct SpringsOfFace<3>;
template class ElasticFoundation<2>;
template class ElasticFoundation<3>;
} // namespace hpvi
