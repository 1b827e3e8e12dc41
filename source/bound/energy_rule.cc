// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/memo_table.h>
#include <hpvi/bound/cell_constants.h>
#include <hpvi/bound/energy_rule.h>
#include <hpvi/bound/legendre.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace hpvi
{
using namespace dealii;

unsigned int map_degree(const CellMap<2> &map)
{
  unsigned int result = 1;
  for (unsigned int face = 0; map.is_curved() && face < 4; ++face)
    if (const EdgeBlend &blend = map.blends()[face])
      result = std::max(result, blend.degree());
  return result;
}

namespace
{
/** det DF, or that times x, over the distance from a face on the axis; positive inside. */
double divisor(const CellMap<2> &map, const std::optional<unsigned int> &on_axis,
               const bool has_circumference, const Point<2> &at)
{
  double result = determinant(map.jacobian(at));
  if (has_circumference)
    result *= map.point(at)[0];
  if (has_circumference && on_axis)
    result /= std::abs(at[*on_axis / 2] - *on_axis % 2);
  return result;
}

/** Its values at points of Gauss, xi down. */
FullMatrix<double> divisors(const CellMap<2> &map, const bool has_circumference,
                            const QGauss<1> &gauss)
{
  const std::optional<unsigned int> on_axis = has_circumference ? axis_face(map) : std::nullopt;
  FullMatrix<double> result(gauss.size(), gauss.size());
  for (unsigned int a = 0; a < gauss.size(); ++a)
    for (unsigned int b = 0; b < gauss.size(); ++b)
      result(a, b) =
          divisor(map, on_axis, has_circumference, {gauss.point(a)[0], gauss.point(b)[0]});
  return result;
}

/** M A M'. */
FullMatrix<double> both_sides(const FullMatrix<double> &M, const FullMatrix<double> &A)
{
  FullMatrix<double> half(M.m(), A.n()), result(M.m(), M.m());
  M.mmult(half, A);
  half.mTmult(result, M);
  return result;
}

/** Of r of degree m, and what its products with D need: n points of Gauss. */
struct Interpolation
{
  Interpolation(const unsigned int m, const unsigned int n)
      : coarse(m + 1), fine(n), to_fine(n, m + 1), to_modes(n, n)
  {
    const auto basis = Polynomials::generate_complete_Lagrange_basis(coarse.get_points());
    for (unsigned int q = 0; q < n; ++q)
    {
      for (unsigned int i = 0; i <= m; ++i)
        to_fine(q, i) = basis[i].value(fine.point(q)[0]);
      const std::vector<double> L = legendre::values(n, 2 * fine.point(q)[0] - 1);
      for (unsigned int i = 0; i < n; ++i) // of P_i, which is at most 1
        to_modes(i, q) = std::sqrt(2.) * fine.weight(q) * L[i] * legendre::root(i);
    }
  }

  QGauss<1> coarse, fine;
  FullMatrix<double> to_fine, to_modes;
};

/** Made once: points cost more than what is done with them. */
const Interpolation &interpolation(const unsigned int m, const unsigned int n)
{
  static std::map<std::pair<unsigned int, unsigned int>, Interpolation> known;
  return memoised(known, {m, n}, [&]() { return Interpolation(m, n); });
}

/** delta for r of degree @p m. */
double reciprocal_error(const CellMap<2> &map, const bool has_circumference, const unsigned int m)
{
  const unsigned int n = m + (has_circumference ? 3 : 2) * map_degree(map);
  const Interpolation &tables = interpolation(m, n);
  FullMatrix<double> r = divisors(map, has_circumference, tables.coarse);
  for (unsigned int a = 0; a <= m; ++a)
    for (unsigned int b = 0; b <= m; ++b)
      r(a, b) = 1 / r(a, b);
  FullMatrix<double> missed = both_sides(tables.to_fine, r);
  const FullMatrix<double> D = divisors(map, has_circumference, tables.fine);
  for (unsigned int a = 0; a < n; ++a)
    for (unsigned int b = 0; b < n; ++b)
      missed(a, b) = 1 - missed(a, b) * D(a, b);
  const FullMatrix<double> modes = both_sides(tables.to_modes, missed);
  double sum = 0;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      sum += std::abs(modes(i, j));
  return sum;
}
} // namespace

EnergyDegrees degrees_of_square(const CellMap<2> &map, const unsigned int p,
                                const bool is_axisymmetric)
{
  const unsigned int g = map_degree(map);
  return {p + (is_axisymmetric ? 2 * g : g), is_axisymmetric};
}

EnergyRule::EnergyRule(const CellMap<2> &map, const EnergyDegrees &degrees,
                       const unsigned int at_least, const double enough)
    : n_gauss(at_least), n_corner(0), factor(1.)
{
  constexpr unsigned int step = 4, most_steps = 3;
  const bool divides = !map.is_affine() || degrees.has_circumference;
  n_gauss = std::max(n_gauss, degrees.stress + 1);
  unsigned int m = 0;
  for (unsigned int k = 0; divides; ++k, n_gauss += step)
  {
    m = 2 * n_gauss - 1 - 2 * degrees.stress;
    double delta = reciprocal_error(map, false, m);
    if (degrees.has_circumference)
      delta = std::max(delta, reciprocal_error(map, true, m));
    factor = delta < 1 ? (1 + delta) / (1 - delta) : std::numeric_limits<double>::infinity();
    if (factor < 1 + enough || k == most_steps)
      break;
  }
  // x = u, y = u t: r has degree 2 m in u. A corner's stress is of degree 6 in x and 4 in y or the other way round, and what is no polynomial
  // of t is within round-off of degree 20.
  const unsigned int g = map_degree(map);
  n_corner = std::max(std::max(2 * degrees.stress, 2 * g + 10) + m + 1,
                      std::max(degrees.stress, g + 26) + m / 2 + 1);
}
} // namespace hpvi
