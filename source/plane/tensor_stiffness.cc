// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/fe/fe_tools.h>
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/plane/tensor_stiffness.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Products of two polynomials: both derived, none, and the sum and difference of the first derived and the second. */
constexpr unsigned int n_kinds = 4, n_symmetric = 3;

/** C_rs for each kind along xi: rs = 00, 11, and 01 twice. */
constexpr std::array<unsigned int, n_kinds> coefficient_of_kind = {{0, 2, 1, 1}};

std::array<double, n_kinds> products_of(const std::array<double, 2> &i,
                                        const std::array<double, 2> &j)
{
  return {{i[1] * j[1], i[0] * j[0], i[1] * j[0] + i[0] * j[1], i[1] * j[0] - i[0] * j[1]}};
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
  result.along.resize(n_pairs * n_kinds * n_points);
  result.across.resize(n_pairs * n_kinds * n_points);
  std::vector<std::array<double, 2>> l(n); // values and derivatives
  for (unsigned int q = 0; q < n_points; ++q)
  {
    for (unsigned int i = 0; i < n; ++i)
      shapes[i].value(gauss.point(q)[0], 1, l[i].data());
    for (unsigned int j = 0, pair = 0; j < n; ++j)
      for (unsigned int i = 0; i <= j; ++i, ++pair)
      {
        const auto [both, none, sum, difference] = products_of(l[i], l[j]);
        const std::array<double, n_kinds> along = {{both, none, sum, difference}},
                                          across = {{none, both, sum / 2, -difference / 2}};
        for (unsigned int kind = 0; kind < n_kinds; ++kind)
        {
          result.along[(kind * n_points + q) * n_pairs + pair] = along[kind];
          result.across[(kind * n_points + q) * n_pairs + pair] = across[kind];
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
    for (unsigned int i2 = 0; i2 <= j2; ++i2)
      for (unsigned int j1 = 0; j1 < n; ++j1)
        for (unsigned int i1 = 0; i1 <= j1; ++i1)
          for (const bool is_swapped : {false, true})
          {
            const unsigned int i = (is_swapped ? j2 : i2) * n + i1,
                               j = (is_swapped ? i2 : j2) * n + j1;
            Half &half = result.halves[is_swapped];
            half.of[0].push_back(place(rows[0][i], rows[0][j]));
            half.of[1].push_back(place(rows[1][i], rows[1][j]));
            half.of[2].push_back(place(rows[0][i], rows[1][j]));
            half.of[3].push_back(place(rows[0][j], rows[1][i]));
            half.rotations.push_back(D[j1 * n + i1] * D[(i / n) * n + j / n] -
                                     D[i1 * n + j1] * D[(j / n) * n + i / n]);
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
        weight *= scene.circumference(map.point(Point<2>(x.points[q1][0], y.points[q2][0])));
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

/**
 * `int x (d_0 phi_i d_1 phi_j - d_1 phi_i d_0 phi_j)` of an axisymmetric body, whose weight the map does not leave out: half of
 * differences along xi times sums along eta, less or, swapped, and sums times differences.
 */
void TensorStiffness::sum_rotations(const Scene<2> &scene, const CellMap<2> &map, const Products &x,
                                    const Products &y, const unsigned int n_pairs)
{
  const unsigned int n_1 = x.points.size(), n_2 = y.points.size();
  std::vector<double> &C = coefficients[0];
  for (unsigned int q2 = 0; q2 < n_2; ++q2)
    for (unsigned int q1 = 0; q1 < n_1; ++q1)
      C[q1 + n_1 * q2] = x.weights[q1] * y.weights[q2] *
                         scene.circumference(map.point(Point<2>(x.points[q1][0], y.points[q2][0])));
  constexpr unsigned int sum = 2, difference = 3;
  for (const bool is_swapped : {false, true})
  {
    rotations[is_swapped].resize(n_pairs * n_pairs);
    for (const unsigned int kind : {sum, difference})
    {
      multiply('N', 'N', n_pairs, n_2, n_1, 1., {&x.along[kind * n_1 * n_pairs], n_pairs},
               {C.data(), n_1}, 0., sums.data(), n_pairs);
      multiply('N', 'T', n_pairs, n_pairs, n_2, kind == sum && is_swapped ? -1. : 1.,
               {sums.data(), n_pairs},
               {&y.across[(sum + difference - kind) * n_2 * n_pairs], n_pairs},
               kind == sum ? 0. : 1., rotations[is_swapped].data(), n_pairs);
    }
  }
}

/** Brings the sums of one pair (i2, j2), or of (j2, i2), to their places in K. */
void TensorStiffness::scatter(const unsigned int pair, const unsigned int n_pairs,
                              const bool is_swapped, const Half &half, const double turning,
                              std::vector<double> &K) const
{
  const std::size_t first = std::size_t(pair) * n_pairs;
  const double *const P = &symmetric[n_blocks * first], *const Q = &skew[n_blocks * first],
                      *const rotation = rotations[is_swapped].empty()
                                            ? &half.rotations[first]
                                            : &rotations[is_swapped][first];
  const double sign = is_swapped ? -1. : 1.;
  for (unsigned int b = 0; b < 2; ++b)
    for (unsigned int k = 0; k < n_pairs; ++k)
      K[half.of[b][first + k]] = P[b * n_pairs + k] + sign * Q[b * n_pairs + k];
  for (unsigned int k = 0; k < n_pairs; ++k)
  {
    const double both = P[2 * n_pairs + k] + sign * Q[2 * n_pairs + k],
                 turned = turning * rotation[k];
    K[half.of[2][first + k]] = both + turned;
    K[half.of[3][first + k]] = both - turned;
  }
}

void TensorStiffness::integrate(const Scene<2> &scene, const CellMap<2> &map,
                                const HookesLaw<2> &law, const unsigned int degree,
                                const std::array<unsigned int, 2> &n_points, std::vector<double> &K)
{
  const Products &x = products(degree, n_points[0]), &y = products(degree, n_points[1]);
  const Places &into = places(degree);
  const unsigned int n = degree + 1, n_pairs = n * (n + 1) / 2, n_rows = n_blocks * n_pairs,
                     n_1 = n_points[0], n_2 = n_points[1];
  tabulate_coefficients(scene, map, law, x, y);
  sums.resize(n_rows * n_kinds * n_2);
  for (unsigned int kind = 0; kind < n_kinds; ++kind)
    multiply('N', 'N', n_pairs, n_blocks * n_2, n_1, 1., {&x.along[kind * n_1 * n_pairs], n_pairs},
             {coefficients[coefficient_of_kind[kind]].data(), n_1}, 0., &sums[kind * n_2 * n_rows],
             n_pairs);
  symmetric.resize(n_rows * n_pairs);
  skew.resize(n_rows * n_pairs);
  multiply('N', 'T', n_rows, n_pairs, n_symmetric * n_2, 1., {sums.data(), n_rows},
           {y.across.data(), n_pairs}, 0., symmetric.data(), n_rows);
  multiply('N', 'T', n_rows, n_pairs, n_2, 1., {&sums[n_symmetric * n_2 * n_rows], n_rows},
           {&y.across[n_symmetric * n_2 * n_pairs], n_pairs}, 0., skew.data(), n_rows);

  double turning = Moduli(law, 0, 1).skew;
  if (scene.is_axisymmetric())
    sum_rotations(scene, map, x, y, n_pairs);
  if (determinant(map.jacobian(Point<2>(0.5, 0.5))) < 0)
    turning = -turning;
  K.resize(4 * n * n * n * n);
  // Both halves of a pair at once: what they write are a few rows of a few columns, which stay in the cache.
  for (unsigned int j2 = 0, pair = 0; j2 < n; ++j2)
    for (unsigned int i2 = 0; i2 <= j2; ++i2, ++pair)
      for (const bool is_swapped : {false, true})
        if (i2 < j2 || !is_swapped)
          scatter(pair, n_pairs, is_swapped, into.halves[is_swapped], turning, K);
}
} // namespace hpvi
