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
} // namespace

template <int dim>
std::vector<Tensor<1, dim>> SpringsOfFace<dim>::forces(const CellField<dim> &u) const
{
  std::vector<Tensor<1, dim>> result(shapes.size());
  for (unsigned int i = 0; i < shapes.size(); ++i)
    for (unsigned int j = 0; j < shapes.size(); ++j)
      result[i] += K[i * shapes.size() + j] * u[shapes[j]];
  return result;
}

// Constant springs meet polynomials of degree 2p: p + 1 points are exact. Others have three more.
template <int dim>
ElasticFoundation<dim>::ElasticFoundation(const Scene<dim> &scene, const DegreeTables<dim> &tables)
    : scene(scene), tables(tables), has_springs(scene.has_springs())
{
  if (!has_springs)
    return;
  for (const BoxTables<dim> &own : tables.all)
  {
    constant.push_back(tables_of_faces<dim>(own.degree, own.degree + 1));
    varying.push_back(tables_of_faces<dim>(own.degree, own.degree + 4));
  }
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
  const unsigned int number = this->tables.number_of(cell);
  const BoxTables<dim> &tables = this->tables.all[number];
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
    const ShapeTable<dim> &table = (own.varies() ? varying : constant)[number][face];
    const unsigned int n = springs.shapes.size();
    springs.K.resize(n * n);
    for (unsigned int q = 0; q < table.points.size(); ++q)
    {
      const auto [k_n, k_t] = own.at(map.point(table.points[q]));
      const double ds = table.weights[q] * map.face_measure(face, table.points[q]);
      const Tensor<1, dim> normal = map.normal(face, table.points[q]);
      const Tensor<2, dim> k = k_t * Tensor<2, dim>(unit_symmetric_tensor<dim>()) +
                               (k_n - k_t) * outer_product(normal, normal);
      springs.sums[0] += ds * k_n;
      springs.sums[1] += ds * k_t;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          springs.K[i * n + j] +=
              ds * table.values(q, springs.shapes[i]) * table.values(q, springs.shapes[j]) * k;
    }
    result.push_back(std::move(springs));
  }
  return result;
}

template <int dim>
void ElasticFoundation<dim>::add_to(FullMatrix<double> &K, const Cell &cell) const
{
  const auto &numbers = tables.of(cell).numbers;
  for (const SpringsOfFace<dim> &springs : below(cell))
    for (unsigned int i = 0; i < springs.shapes.size(); ++i)
      for (unsigned int j = 0; j < springs.shapes.size(); ++j)
      {
        const Tensor<2, dim> &k = springs.K[i * springs.shapes.size() + j];
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            K(numbers[springs.shapes[i]][c], numbers[springs.shapes[j]][d]) += k[c][d];
      }
}

template <int dim>
void ElasticFoundation<dim>::add_to_diagonal(std::vector<double> &diagonal, const Cell &cell) const
{
  const auto &numbers = tables.of(cell).numbers;
  for (const SpringsOfFace<dim> &springs : below(cell))
    for (unsigned int i = 0; i < springs.shapes.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        diagonal[numbers[springs.shapes[i]][c]] += springs.K[i * springs.shapes.size() + i][c][c];
}

template struct SpringsOfFace<2>;
template struct SpringsOfFace<3>;
template class ElasticFoundation<2>;
template class ElasticFoundation<3>;
} // namespace hpvi
