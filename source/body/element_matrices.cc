// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/element_matrices.h>

#include <cmath>
#include <iterator>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Matrices P_ab = int d_a phi_i d_b phi_j over the cell, for all pairs of directions. */
template <int dim>
std::array<std::array<FullMatrix<double>, dim>, dim> gradient_products(const CellMap<dim> &map,
                                                                       const ShapeTable<dim> &table)
{
  const unsigned int n_points = table.points.size(), n = table.n_shapes;
  std::array<FullMatrix<double>, dim> G;
  for (auto &g : G)
    g.reinit(n_points, n);
  for (unsigned int q = 0; q < n_points; ++q)
  {
    const Tensor<2, dim> J = map.jacobian(table.points[q]);
    const Tensor<2, dim> inverse = invert(J);
    const double weight = std::sqrt(table.weights[q] * std::abs(determinant(J)));
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
} // namespace

template <int dim>
unsigned int stiffness_points(const CellMap<dim> &map, const unsigned int degree)
{
  if (map.is_affine())
    return degree + 1;
  double quotient = 1.;
  for (const unsigned int v : GeometryInfo<dim>::vertex_indices())
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double here = determinant(map.jacobian(GeometryInfo<dim>::unit_cell_vertex(v))),
                   there = determinant(
                       map.jacobian(GeometryInfo<dim>::unit_cell_vertex(v ^ (1u << d))));
      quotient = std::max(quotient, here / there);
    }
  constexpr double tolerance = 1e-14;
  constexpr unsigned int most = 40; // beyond a quotient of 30 corners are all but flat
  const double root = std::sqrt(quotient),
               extra = -std::log(tolerance) / (2 * std::log((root + 1) / (root - 1)));
  return degree + 1 + static_cast<unsigned int>(std::ceil(std::min<double>(extra, most)));
}

namespace
{
/**
 * @p K_ii := the block of @p K that belongs to the unknowns inside the cell, by its Cholesky factor. Not
 * returned: a copy of deal.II's matrix forgets that it is a factor.
 */
void factor_interior(const FullMatrix<double> &K, const unsigned int n_boundary,
                     LAPACKFullMatrix<double> &K_ii)
{
  const unsigned int n_interior = K.m() - n_boundary;
  K_ii.reinit(n_interior);
  for (unsigned int i = 0; i < n_interior; ++i)
    for (unsigned int j = 0; j < n_interior; ++j)
      K_ii(i, j) = K(n_boundary + i, n_boundary + j);
  K_ii.set_property(LAPACKSupport::symmetric);
  K_ii.compute_cholesky_factorization();
}
} // namespace

template <int dim>
ElementStiffnesses<dim>::ElementStiffnesses(const Scene<dim> &scene, const ShapeTables<dim> &tables)
    : materials(scene.materials), interior_loads(scene.has_body_force()), tables(tables)
{
}

/** Edge vectors from vertex 0, scaled to unit size where scale does not matter, and rounded. */
template <int dim>
typename ElementStiffnesses<dim>::Key
ElementStiffnesses<dim>::congruence_class(const typename CellMap<dim>::Vertices &vertices,
                                          const unsigned int degree,
                                          const types::material_id material)
{
  double size = 1.;
  if (dim == 2)
  {
    size = 0;
    for (const Point<dim> &v : vertices)
      size = std::max(size, (v - vertices[0]).norm());
  }
  Key key;
  auto entry = key.begin();
  *entry++ = degree;
  *entry++ = material;
  for (const Point<dim> &v : vertices)
    for (unsigned int d = 0; d < dim; ++d)
      *entry++ = std::lround((v[d] - vertices[0][d]) / size * 1e11);
  return key;
}

template <int dim>
FullMatrix<double> ElementStiffnesses<dim>::stiffness(const CellMap<dim> &map,
                                                      const unsigned int degree,
                                                      const types::material_id material) const
{
  const auto P = gradient_products(map, tables.gradients(degree, stiffness_points(map, degree)));
  const LocalNumbering &numbering = tables.numbering(degree);
  const StiffnessFormula<dim> product(materials[material]);
  const unsigned int n = numbering.shape.size();
  FullMatrix<double> K(n, n);
  for (unsigned int row = 0; row < n; ++row)
    for (unsigned int column = 0; column < n; ++column)
    {
      const unsigned int i = numbering.shape[row], c = numbering.component[row];
      const unsigned int j = numbering.shape[column], d = numbering.component[column];
      K(row, column) =
          product([&](const unsigned int a, const unsigned int b) { return P[a][b](i, j); }, c, d);
    }
  return K;
}

template <int dim>
std::shared_ptr<ElementStiffness>
ElementStiffnesses<dim>::condense(const FullMatrix<double> &K, const unsigned int n_boundary) const
{
  auto element = std::make_shared<ElementStiffness>();
  const unsigned int n_interior = K.m() - n_boundary;
  element->condensed.reinit(n_boundary, n_boundary);
  element->condensed.fill(K, 0, 0, 0, 0);
  if (n_interior > 0)
  {
    LAPACKFullMatrix<double> K_ii, K_ib(n_interior, n_boundary);
    factor_interior(K, n_boundary, K_ii);
    for (unsigned int i = 0; i < n_interior; ++i)
      for (unsigned int j = 0; j < n_boundary; ++j)
        K_ib(i, j) = -K(n_boundary + i, j);
    K_ii.solve(K_ib);
    element->extension.reinit(n_interior, n_boundary);
    element->extension = K_ib;
    FullMatrix<double> K_bi(n_boundary, n_interior);
    K_bi.fill(K, 0, 0, 0, n_boundary);
    K_bi.mmult(element->condensed, element->extension, /*adding=*/true);
    if (interior_loads)
      element->K_ii = K_ii;
  }
  return element;
}

template <int dim>
std::shared_ptr<const ElementStiffness>
ElementStiffnesses<dim>::get(const CellMap<dim> &map, const unsigned int degree,
                             const types::material_id material)
{
  auto &entry = known[congruence_class(map.vertices(), degree, material)];
  std::shared_ptr<const ElementStiffness> element = entry.lock();
  if (!element)
  {
    element = condense(stiffness(map, degree, material), tables.numbering(degree).n_boundary);
    entry = element;
  }
  return element;
}

template <int dim>
void ElementStiffnesses<dim>::interior(const CellMap<dim> &map, const unsigned int degree,
                                       const types::material_id material,
                                       LAPACKFullMatrix<double> &K_ii) const
{
  factor_interior(stiffness(map, degree, material), tables.numbering(degree).n_boundary, K_ii);
}

namespace
{
/** T' K T, first its rows, then its columns: T is nearly the identity. */
FullMatrix<double> congruence(const std::vector<ConstraintEntry> &T, const unsigned int n_targets,
                              const FullMatrix<double> &K)
{
  FullMatrix<double> rows(n_targets, K.n()), result(n_targets, n_targets);
  for (const ConstraintEntry &entry : T)
  {
    double *const sum = &rows(entry.target, 0);
    const double *const row = &K(entry.local, 0);
    for (unsigned int j = 0; j < K.n(); ++j)
      sum[j] += entry.weight * row[j];
  }
  for (unsigned int i = 0; i < n_targets; ++i)
  {
    double *const sum = &result(i, 0);
    const double *const row = &rows(i, 0);
    for (const ConstraintEntry &entry : T)
      sum[entry.target] += entry.weight * row[entry.local];
  }
  return result;
}
} // namespace

template <int dim>
std::shared_ptr<const FullMatrix<double>>
ElementStiffnesses<dim>::constrained(const std::shared_ptr<const ElementStiffness> &element,
                                     const std::vector<ConstraintEntry> &T,
                                     const unsigned int n_targets)
{
  auto &entry = known_constrained[{element, T}];
  std::shared_ptr<const FullMatrix<double>> matrix = entry.lock();
  if (!matrix)
  {
    matrix =
        std::make_shared<const FullMatrix<double>>(congruence(T, n_targets, element->condensed));
    entry = matrix;
  }
  return matrix;
}

template <int dim>
void ElementStiffnesses<dim>::forget_unused()
{
  for (auto entry = known_constrained.begin(); entry != known_constrained.end();)
    entry = entry->second.expired() ? known_constrained.erase(entry) : std::next(entry);
}

template unsigned int stiffness_points(const CellMap<2> &, unsigned int);
template class ElementStiffnesses<2>;
} // namespace hpvi
