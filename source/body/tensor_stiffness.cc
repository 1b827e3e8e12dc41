// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/fe/fe_tools.h>
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/body/tensor_stiffness.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int n_kinds = 4; // which of two polynomials are derived

/** C_rs for each kind: both, first, second, none derived along xi are rs = 00, 01, 10, 11. */
constexpr std::array<unsigned int, n_kinds> coefficient_of_kind = {{0, 1, 1, 2}};

/** Is the first (0) or second (1) of two polynomials derived? */
bool is_derived(const unsigned int kind, const unsigned int which)
{
  return kind == 0 || kind == 1 + which;
}
} // namespace

TensorStiffness::TensorStiffness(const ShapeTables<2> &tables) : tables(tables)
{
}

const TensorStiffness::Products &TensorStiffness::products(const unsigned int degree,
                                                           const unsigned int n_points)
{
  const auto found = known_products.find({{degree, n_points}});
  if (found != known_products.end())
    return found->second;
  const QGauss<1> &gauss = tables.gauss(n_points);
  Products result{{}, {}, gauss.get_points(), gauss.get_weights()};
  const unsigned int n = degree + 1, n_pairs = n * (n + 1) / 2;
  const auto shapes =
      Polynomials::generate_complete_Lagrange_basis(tables.gauss_lobatto(n).get_points());
  result.pairs.resize(n_pairs * n_kinds * n_points);
  result.all.resize(n_kinds * n_points * n * n);
  std::vector<std::array<double, 2>> l(n); // values and derivatives
  for (unsigned int q = 0; q < n_points; ++q)
  {
    for (unsigned int i = 0; i < n; ++i)
      shapes[i].value(gauss.point(q)[0], 1, l[i].data());
    for (unsigned int kind = 0; kind < n_kinds; ++kind)
    {
      const bool first = is_derived(kind, 0), second = is_derived(kind, 1);
      for (unsigned int j = 0, pair = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
        {
          // What is derived along xi is not along eta.
          result.all[(j * n + i) * n_kinds * n_points + kind * n_points + q] =
              l[i][!first] * l[j][!second];
          if (i <= j)
            result.pairs[(kind * n_points + q) * n_pairs + pair++] = l[i][first] * l[j][second];
        }
    }
  }
  return known_products.emplace(std::array<unsigned int, 2>{{degree, n_points}}, std::move(result))
      .first->second;
}

namespace
{
/** int l_i' l_j over the unit interval, i + n j. */
std::vector<double> first_derived(const unsigned int n, const ShapeTables<2> &tables)
{
  const QGauss<1> &gauss = tables.gauss(n);
  const auto shapes =
      Polynomials::generate_complete_Lagrange_basis(tables.gauss_lobatto(n).get_points());
  std::vector<double> result(n * n);
  std::vector<std::array<double, 2>> l(n);
  for (unsigned int q = 0; q < n; ++q)
  {
    for (unsigned int i = 0; i < n; ++i)
      shapes[i].value(gauss.point(q)[0], 1, l[i].data());
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        result[j * n + i] += gauss.weight(q) * l[i][1] * l[j][0];
  }
  return result;
}

/** Where each unknown stands in K, by component and lexicographic number. */
std::array<std::vector<unsigned int>, 2> rows_in_triangle(const LocalNumbering &numbering,
                                                          const unsigned int degree)
{
  const auto lexicographic = FETools::hierarchic_to_lexicographic_numbering<2>(degree);
  const unsigned int n = numbering.shape.size(), n_inside = n - numbering.n_boundary;
  std::array<std::vector<unsigned int>, 2> rows;
  for (auto &of_component : rows)
    of_component.resize(n / 2);
  for (unsigned int k = 0; k < n; ++k)
    rows[numbering.component[k]][lexicographic[numbering.shape[k]]] =
        k < numbering.n_boundary ? n_inside + k : k - numbering.n_boundary;
  return rows;
}
} // namespace

const TensorStiffness::Places &TensorStiffness::places(const unsigned int degree)
{
  const auto [found, is_new] = known_places.try_emplace(degree);
  Places &result = found->second;
  if (!is_new)
    return result;
  const unsigned int n = degree + 1, size = 2 * n * n;
  const std::vector<double> D = first_derived(n, tables);
  const auto rows = rows_in_triangle(tables.numbering(degree), degree);
  const auto place = [&](const unsigned int a, const unsigned int b)
  { return std::max(a, b) + size * std::min(a, b); };
  for (unsigned int j2 = 0; j2 < n; ++j2)
    for (unsigned int i2 = 0; i2 < n; ++i2)
      for (unsigned int j1 = 0; j1 < n; ++j1)
        for (unsigned int i1 = 0; i1 <= j1; ++i1)
        {
          const unsigned int i = i2 * n + i1, j = j2 * n + j1;
          result.of[0].push_back(place(rows[0][i], rows[0][j]));
          result.of[1].push_back(place(rows[1][i], rows[1][j]));
          result.of[2].push_back(place(rows[0][i], rows[1][j]));
          result.of[3].push_back(place(rows[0][j], rows[1][i]));
          result.rotations.push_back(D[j1 * n + i1] * D[i2 * n + j2] -
                                     D[i1 * n + j1] * D[j2 * n + i2]);
        }
  return result;
}

namespace
{
/** The moduli of a law between the gradients of two components. */
struct Moduli
{
  /** Of `d_0 phi d_0 psi`, `d_1 phi d_1 psi`, and of `d_0 phi d_1 psi` the symmetric and the skew half. */
  double xx, yy, symmetric, skew;

  Moduli(const HookesLaw<2> &law, const unsigned int c, const unsigned int d)
  {
    const auto modulus = [&](const unsigned int a, const unsigned int b)
    {
      return law.stiffness([&](const unsigned int r, const unsigned int s)
                           { return r == a && s == b ? 1. : 0.; },
                           c, d);
    };
    xx = modulus(0, 0);
    yy = modulus(1, 1);
    symmetric = (modulus(0, 1) + modulus(1, 0)) / 2;
    skew = (modulus(0, 1) - modulus(1, 0)) / 2;
  }
};

/** Jacobians at a grid of points: straight edges make each column of them depend on one coordinate alone. */
class Jacobians
{
public:
  Jacobians(const CellMap<2> &map, const std::vector<Point<1>> &x, const std::vector<Point<1>> &y)
      : map(map), x(x), y(y), is_curved(map.is_curved())
  {
    for (unsigned int q = 0; !is_curved && q < y.size(); ++q)
      along_x.push_back(map.jacobian(Point<2>(0.5, y[q][0])));
    for (unsigned int q = 0; !is_curved && q < x.size(); ++q)
      along_y.push_back(map.jacobian(Point<2>(x[q][0], 0.5)));
  }

  Tensor<2, 2> operator()(const unsigned int q1, const unsigned int q2) const
  {
    if (is_curved)
      return map.jacobian(Point<2>(x[q1][0], y[q2][0]));
    Tensor<2, 2> J;
    for (unsigned int i = 0; i < 2; ++i)
    {
      J[i][0] = along_x[q2][i][0];
      J[i][1] = along_y[q1][i][1];
    }
    return J;
  }

private:
  const CellMap<2> &map;
  const std::vector<Point<1>> &x, &y;
  const bool is_curved;
  std::vector<Tensor<2, 2>> along_x, along_y;
};
} // namespace

void TensorStiffness::tabulate_coefficients(const Scene<2> &scene, const CellMap<2> &map,
                                            const HookesLaw<2> &law, const Products &x,
                                            const Products &y)
{
  const unsigned int n_1 = x.points.size(), n_2 = y.points.size();
  const std::array<Moduli, n_blocks> moduli = {
      {Moduli(law, 0, 0), Moduli(law, 1, 1), Moduli(law, 0, 1)}};
  const Jacobians jacobians(map, x.points, y.points);
  const bool has_turn = scene.is_axisymmetric();
  for (auto &C : coefficients)
    C.resize(n_1 * n_blocks * n_2);
  for (unsigned int q2 = 0; q2 < n_2; ++q2)
    for (unsigned int q1 = 0; q1 < n_1; ++q1)
    {
      const Tensor<2, 2> J = jacobians(q1, q2);
      double weight = x.weights[q1] * y.weights[q2] / std::abs(determinant(J));
      if (has_turn)
        weight *= scene.turn(map.point(Point<2>(x.points[q1][0], y.points[q2][0])));
      // Rows of the inverse times det J: the gradients of xi and eta.
      const double a[2][2] = {{J[1][1], -J[0][1]}, {-J[1][0], J[0][0]}};
      for (unsigned int r = 0, k = 0; r < 2; ++r)
        for (unsigned int s = r; s < 2; ++s, ++k)
        {
          const double xx = weight * a[r][0] * a[s][0], yy = weight * a[r][1] * a[s][1],
                       xy = weight * (a[r][0] * a[s][1] + a[r][1] * a[s][0]);
          double *const C = &coefficients[k][q1 + n_1 * n_blocks * q2];
          for (unsigned int b = 0; b < n_blocks; ++b)
            C[n_1 * b] = moduli[b].xx * xx + moduli[b].yy * yy + moduli[b].symmetric * xy;
        }
    }
}

/** `int x (d_0 phi_i d_1 phi_j - d_1 phi_i d_0 phi_j)` of an axisymmetric body, whose weight the map does not leave out. */
void TensorStiffness::sum_rotations(const Scene<2> &scene, const CellMap<2> &map, const Products &x,
                                    const Products &y, const unsigned int n_pairs,
                                    const unsigned int n_shapes)
{
  const unsigned int n_1 = x.points.size(), n_2 = y.points.size();
  std::vector<double> &C = coefficients[0];
  for (unsigned int q2 = 0; q2 < n_2; ++q2)
    for (unsigned int q1 = 0; q1 < n_1; ++q1)
      C[q1 + n_1 * q2] = x.weights[q1] * y.weights[q2] *
                         scene.turn(map.point(Point<2>(x.points[q1][0], y.points[q2][0])));
  for (unsigned int half = 0; half < 2; ++half) // kinds 1 and 2
    multiply('N', 'N', n_pairs, n_2, n_1, half == 0 ? 1. : -1.,
             {&x.pairs[(1 + half) * n_1 * n_pairs], n_pairs}, {C.data(), n_1}, 0.,
             &sums[half * n_2 * n_pairs], n_pairs);
  rotations.resize(n_pairs * n_shapes);
  multiply('N', 'N', n_pairs, n_shapes, 2 * n_2, 1., {sums.data(), n_pairs},
           {&y.all[n_2], n_kinds * n_2}, 0., rotations.data(), n_pairs);
}

void TensorStiffness::integrate(const Scene<2> &scene, const CellMap<2> &map,
                                const HookesLaw<2> &law, const unsigned int degree,
                                const std::array<unsigned int, 2> &n_points, std::vector<double> &K)
{
  const Products &x = products(degree, n_points[0]), &y = products(degree, n_points[1]);
  const Places &into = places(degree);
  const unsigned int n = degree + 1, n_pairs = n * (n + 1) / 2, n_rows = n_blocks * n_pairs;
  tabulate_coefficients(scene, map, law, x, y);
  sums.resize(n_rows * n_kinds * n_points[1]);
  for (unsigned int kind = 0; kind < n_kinds; ++kind)
    multiply('N', 'N', n_pairs, n_blocks * n_points[1], n_points[0], 1.,
             {&x.pairs[kind * n_points[0] * n_pairs], n_pairs},
             {coefficients[coefficient_of_kind[kind]].data(), n_points[0]}, 0.,
             &sums[kind * n_points[1] * n_rows], n_pairs);
  result.resize(n_rows * n * n);
  multiply('N', 'N', n_rows, n * n, n_kinds * n_points[1], 1., {sums.data(), n_rows},
           {y.all.data(), n_kinds * n_points[1]}, 0., result.data(), n_rows);

  const double *rotation = into.rotations.data();
  double skew = Moduli(law, 0, 1).skew;
  if (scene.is_axisymmetric())
  {
    sum_rotations(scene, map, x, y, n_pairs, n * n);
    rotation = rotations.data();
  }
  if (determinant(map.jacobian(Point<2>(0.5, 0.5))) < 0)
    skew = -skew;
  K.resize(4 * n * n * n * n);
  for (unsigned int column = 0; column < n * n; ++column)
  {
    const double *const values = &result[column * n_rows];
    const std::size_t first = std::size_t(column) * n_pairs;
    for (unsigned int b = 0; b < 2; ++b)
      for (unsigned int k = 0; k < n_pairs; ++k)
        K[into.of[b][first + k]] = values[b * n_pairs + k];
    for (unsigned int k = 0; k < n_pairs; ++k)
    {
      const double both = values[2 * n_pairs + k], turned = skew * rotation[first + k];
      K[into.of[2][first + k]] = both + turned;
      K[into.of[3][first + k]] = both - turned;
    }
  }
}
} // namespace hpvi
