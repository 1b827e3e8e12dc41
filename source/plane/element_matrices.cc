// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/polynomial.h>
#include <hpvi/plane/element_matrices.h>
#include <hpvi/plane/tensor_stiffness.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Matrices P_ab = int d_a phi_i d_b phi_j over the cell, for all pairs of directions. */
template <int dim>
std::array<std::array<FullMatrix<double>, dim>, dim>
gradient_products(const Scene<dim> &scene, const CellMap<dim> &map, const ShapeTable<dim> &table)
{
  const unsigned int n_points = table.points.size(), n = table.n_shapes;
  std::array<FullMatrix<double>, dim> G;
  for (auto &g : G)
    g.reinit(n_points, n);
  for (unsigned int q = 0; q < n_points; ++q)
  {
    const Tensor<2, dim> J = map.jacobian(table.points[q]);
    const Tensor<2, dim> inverse = invert(J);
    const double weight = std::sqrt(table.weights[q] * std::abs(determinant(J)) *
                                    scene.circumference(map.point(table.points[q])));
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int r = 0; r < dim; ++r)
          G[a](q, i) += weight * inverse[r][a] * table.derivatives(q * table.rows_per_point + r, i);
  }
  std::array<std::array<FullMatrix<double>, dim>, dim> P;
  for (unsigned int a = 0; a < dim; ++a)
    for (unsigned int b = 0; b < dim; ++b)
    {
      P[a][b].reinit(n, n);
      G[a].Tmmult(P[a][b], G[b]);
    }
  return P;
}

/** What strains around the axis add; products with them are one more direction of gradient_products(). */
template <int dim>
void add_hoop_stiffness(const CellMap<dim> &map, const HookesLaw<dim> &law,
                        const ShapeTable<dim> &table, const LocalNumbering &numbering,
                        FullMatrix<double> &K)
{
  const unsigned int n_points = table.points.size(), n = table.n_shapes;
  std::array<FullMatrix<double>, dim> G, Q;
  FullMatrix<double> H(n_points, n), M(n, n);
  for (unsigned int a = 0; a < dim; ++a)
  {
    G[a].reinit(n_points, n);
    Q[a].reinit(n, n);
  }
  for (unsigned int q = 0; q < n_points; ++q)
  {
    const Tensor<2, dim> J = map.jacobian(table.points[q]), inverse = invert(J);
    const Point<dim> x = map.point(table.points[q]);
    const double weight = std::sqrt(table.weights[q] * std::abs(determinant(J)) * full_turn(x));
    for (unsigned int i = 0; i < n; ++i)
    {
      H(q, i) = weight * table.values(q, i) / x[0];
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int r = 0; r < dim; ++r)
          G[a](q, i) += weight * inverse[r][a] * table.derivatives(q * table.rows_per_point + r, i);
    }
  }
  H.Tmmult(M, H);
  for (unsigned int a = 0; a < dim; ++a)
    G[a].Tmmult(Q[a], H);
  for (unsigned int row = 0; row < K.m(); ++row)
    for (unsigned int column = 0; column < K.m(); ++column)
    {
      const unsigned int i = numbering.shape[row], j = numbering.shape[column];
      K(row, column) +=
          law.hoop_stiffness([&](const unsigned int a) { return Q[a](i, j); },
                             [&](const unsigned int a) { return Q[a](j, i); }, M(i, j),
                             numbering.component[row], numbering.component[column]);
    }
}

/** lambda times the products of what the projection takes away from div v, on a parallelogram. */
template <int dim>
void subtract_oscillations(const CellMap<dim> &map, const unsigned int degree, const double lambda,
                           const ShapeTables<dim> &tables, FullMatrix<double> &K)
{
  const ShapeTable<dim> &table = tables.gradients(degree, degree + 1);
  const LocalNumbering &numbering = tables.numbering(degree);
  const unsigned int n_points = table.points.size();
  const Tensor<2, dim> J = map.jacobian(table.points[0]), inverse = invert(J);
  FullMatrix<double> divergence(n_points, K.m()), modes = oscillating_modes(table, degree);
  for (unsigned int q = 0; q < n_points; ++q)
    for (unsigned int i = 0; i < K.m(); ++i)
      for (unsigned int r = 0; r < dim; ++r)
        divergence(q, i) += table.weights[q] * inverse[r][numbering.component[i]] *
                            table.derivatives(q * table.rows_per_point + r, numbering.shape[i]);
  FullMatrix<double> D(modes.m(), K.m()), products(K.m(), K.m());
  modes.mmult(D, divergence);
  D.Tmmult(products, D);
  K.add(-lambda * std::abs(determinant(J)), products);
}
} // namespace

template <int dim>
FullMatrix<double> oscillating_modes(const ShapeTable<dim> &table, const unsigned int degree)
{
  static_assert(dim == 2, "products of two polynomials");
  const auto L = Polynomials::Legendre::generate_complete_basis(degree);
  FullMatrix<double> result((degree + 1) * (degree + 2) / 2, table.points.size());
  unsigned int mode = 0;
  for (unsigned int i = 0; i <= degree; ++i)
    for (unsigned int j = degree - i; j <= degree; ++j, ++mode)
      for (unsigned int q = 0; q < table.points.size(); ++q)
        result(mode, q) = L[i].value(table.points[q][0]) * L[j].value(table.points[q][1]);
  return result;
}

namespace
{
/** With p+1 points loads and stresses agree for every constant stress; what the map divides by converges as the solution does. */
constexpr unsigned int further_points_on_curves = 2;

/** For a pole where a linear function vanishes, whose values at the ends of an interval have this @p quotient. */
unsigned int further_points(const double quotient)
{
  constexpr double tolerance = 1e-14;
  constexpr unsigned int most = 40; // beyond a quotient of 30 corners are all but flat
  const double root = std::sqrt(quotient),
               extra = -std::log(tolerance) / (2 * std::log((root + 1) / (root - 1)));
  return static_cast<unsigned int>(std::ceil(std::min<double>(extra, most)));
}

/** In each direction of the reference cell, for the quotients of det J at the ends of edges that run there. */
template <int dim>
std::array<unsigned int, dim> points_by_direction(const CellMap<dim> &map,
                                                  const unsigned int degree)
{
  std::array<unsigned int, dim> result;
  result.fill(degree + 1 + (map.is_curved() ? further_points_on_curves : 0));
  if (map.is_affine() || map.is_curved())
    return result;
  std::array<double, GeometryInfo<dim>::vertices_per_cell> volumes;
  for (const unsigned int v : GeometryInfo<dim>::vertex_indices())
    volumes[v] = determinant(map.jacobian(GeometryInfo<dim>::unit_cell_vertex(v)));
  for (unsigned int d = 0; d < dim; ++d)
  {
    double quotient = 1.;
    for (const unsigned int v : GeometryInfo<dim>::vertex_indices())
      quotient = std::max(quotient, volumes[v] / volumes[v ^ (1u << d)]);
    result[d] = degree + std::max(1U, further_points(quotient));
  }
  return result;
}

/** The same in the body of a scene. */
template <int dim>
std::array<unsigned int, dim> points_by_direction(const Scene<dim> &scene, const CellMap<dim> &map,
                                                  const unsigned int degree)
{
  std::array<unsigned int, dim> result = points_by_direction(map, degree);
  if (!scene.is_axisymmetric())
    return result;
  double least = std::numeric_limits<double>::max(), largest = 0;
  for (const Point<dim> &v : map.vertices())
    largest = std::max(largest, v[0]);
  for (const Point<dim> &v : map.vertices())
    if (v[0] > 1e-12 * largest) // what vanishes on the axis is divided by x without a pole there
      least = std::min(least, v[0]);
  for (unsigned int &n : result)
    n = std::max(n, degree + 1 + further_points(largest / least));
  return result;
}
} // namespace

template <int dim>
unsigned int stiffness_points(const CellMap<dim> &map, const unsigned int degree)
{
  const auto points = points_by_direction(map, degree);
  return *std::max_element(points.begin(), points.end());
}

template <int dim>
unsigned int stiffness_points(const Scene<dim> &scene, const CellMap<dim> &map,
                              const unsigned int degree)
{
  const auto points = points_by_direction(scene, map, degree);
  return *std::max_element(points.begin(), points.end());
}

template <int dim>
ElementMatrices<dim>::ElementMatrices(const Scene<dim> &scene, const ShapeTables<dim> &tables,
                                      const Volume volume)
    : volume(volume), scene(scene), tables(tables),
      factorised(std::make_shared<TensorStiffness>(tables))
{
}

namespace
{
/** A number for curved edges, as good as different for different ones; 0 stands for straight ones. */
long shape_of(const EdgeBlends &blends, const double size)
{
  std::uint64_t hash = 1469598103934665603U; // after Fowler, Noll and Vo
  for (unsigned int f = 0; f < blends.size(); ++f)
    for (unsigned int k = 1; blends[f] && k < 8; ++k)
    {
      const Tensor<1, 2> blend = blends[f](k / 8. + 0.01)[0];
      for (const long part :
           {long(f + 1), std::lround(blend[0] / size * 1e11), std::lround(blend[1] / size * 1e11)})
        hash = (hash ^ static_cast<std::uint64_t>(part)) * 1099511628211U;
    }
  return static_cast<long>(hash | 1U);
}
} // namespace

/** Edge vectors from vertex 0, scaled to unit size where scale does not matter, and rounded. */
template <int dim>
typename ElementMatrices<dim>::Class
ElementMatrices<dim>::congruence_class(const CellMap<dim> &map, const unsigned int degree,
                                       const types::material_id material) const
{
  const typename CellMap<dim>::Vertices &vertices = map.vertices();
  double size = 1.;
  if (dim == 2)
  {
    size = 0;
    for (const Point<dim> &v : vertices)
      size = std::max(size, (v - vertices[0]).norm());
  }
  Class key{};
  auto entry = key.begin();
  *entry++ = degree;
  *entry++ = material;
  for (const Point<dim> &v : vertices)
    for (unsigned int d = 0; d < dim; ++d)
      *entry++ = std::lround((v[d] - vertices[0][d]) / size * 1e11);
  if (scene.is_axisymmetric())
  {
    key[2] = std::lround(std::min(vertices[0][0] / size, 1e7) * 1e11);
    key[3] = std::lround(std::log(size) * 1e11);
  }
  if constexpr (dim == 2)
    if (map.is_curved())
      key.back() = shape_of(map.blends(), size);
  return key;
}

template <int dim>
FullMatrix<double> ElementMatrices<dim>::stiffness(const CellMap<dim> &map,
                                                   const unsigned int degree,
                                                   const types::material_id material) const
{
  if (is_factorised(map))
    return from_triangle(map, degree, material);
  const ShapeTable<dim> &table = tables.gradients(degree, stiffness_points(scene, map, degree));
  const auto P = gradient_products(scene, map, table);
  const LocalNumbering &numbering = tables.numbering(degree);
  const Material &hooke = scene.materials[material];
  const HookesLaw<dim> law(hooke);
  const unsigned int n = numbering.shape.size();
  FullMatrix<double> K(n, n);
  for (unsigned int row = 0; row < n; ++row)
    for (unsigned int column = 0; column < n; ++column)
    {
      const unsigned int i = numbering.shape[row], c = numbering.component[row];
      const unsigned int j = numbering.shape[column], d = numbering.component[column];
      K(row, column) = law.stiffness(
          [&](const unsigned int a, const unsigned int b) { return P[a][b](i, j); }, c, d);
    }
  if (volume == Volume::projected && hooke.is_nearly_incompressible(dim))
    subtract_oscillations(map, degree, law.volume_modulus(), tables, K);
  if (scene.is_axisymmetric())
    add_hoop_stiffness(map, law, table, numbering, K);
  return K;
}

template <int dim>
bool ElementMatrices<dim>::is_factorised(const CellMap<dim> &map) const
{
  return !map.is_affine() && volume == Volume::full;
}

template <int dim>
void ElementMatrices<dim>::triangle(const CellMap<dim> &map, const unsigned int degree,
                                    const types::material_id material, std::vector<double> &K) const
{
  const HookesLaw<dim> law(scene.materials[material]);
  factorised->integrate(scene, map, law, degree, points_by_direction(scene, map, degree), K);
  if (!scene.is_axisymmetric())
    return;
  const LocalNumbering &numbering = tables.numbering(degree);
  const unsigned int n = numbering.shape.size();
  FullMatrix<double> hoop(n, n);
  add_hoop_stiffness(map, law, tables.gradients(degree, stiffness_points(scene, map, degree)),
                     numbering, hoop);
  for (unsigned int column = 0; column < n; ++column)
    for (unsigned int row = column; row < n; ++row)
      K[std::size_t(column) * n + row] +=
          hoop((row + numbering.n_boundary) % n, (column + numbering.n_boundary) % n);
}

template <int dim>
FullMatrix<double> ElementMatrices<dim>::from_triangle(const CellMap<dim> &map,
                                                       const unsigned int degree,
                                                       const types::material_id material) const
{
  std::vector<double> K;
  triangle(map, degree, material, K);
  const LocalNumbering &numbering = tables.numbering(degree);
  const unsigned int n = numbering.shape.size(), n_boundary = numbering.n_boundary;
  FullMatrix<double> result(n, n);
  for (unsigned int column = 0; column < n; ++column)
    for (unsigned int row = column; row < n; ++row)
    {
      const unsigned int i = (row + n_boundary) % n, j = (column + n_boundary) % n;
      result(i, j) = result(j, i) = K[std::size_t(column) * n + row];
    }
  return result;
}

template <int dim>
unsigned int ElementMatrices<dim>::n_boundary(const unsigned int degree) const
{
  return tables.numbering(degree).n_boundary;
}

template unsigned int stiffness_points(const CellMap<2> &, unsigned int);
template unsigned int stiffness_points(const Scene<2> &, const CellMap<2> &, unsigned int);
template FullMatrix<double> oscillating_modes(const ShapeTable<2> &, unsigned int);
template class ElementMatrices<2>;
} // namespace hpvi
