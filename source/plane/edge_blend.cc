// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/edge_blend.h>

#include <deal.II/base/quadrature_lib.h>

#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int largest_degree = 40;

/** Of polynomials up to largest_degree and two derivatives, not all of them set: maps are asked too often for vectors. */
using Values = std::array<std::array<double, largest_degree + 1>, 3>;

/** P_k(2 s - 1) for k = 0 ... n and its derivatives by s up to @p order, one list after the other. */
Values legendre(const double s, const unsigned int n, const unsigned int order)
{
  const double x = 2 * s - 1;
  Values P;
  P[0][0] = 1;
  for (unsigned int d = 1; d <= order; ++d)
    P[d][0] = 0;
  for (unsigned int k = 1; k <= n; ++k)
  {
    const double before = k > 1 ? P[0][k - 2] : 0.;
    P[0][k] = ((2 * k - 1) * x * P[0][k - 1] - (k - 1) * before) / k;
    // P'_k = P'_{k-2} + (2k-1) P_{k-1} in x, and each derivative by s is twice that by x
    for (unsigned int d = 1; d <= order; ++d)
      P[d][k] = (k > 1 ? P[d][k - 2] : 0.) + 2 * (2 * k - 1) * P[d - 1][k - 1];
  }
  return P;
}

/** Gauss-Lobatto nodes and weights, made once: nodes cost more than all that is done with them. */
const QGaussLobatto<1> &nodes_of(const unsigned int degree)
{
  static const std::vector<QGaussLobatto<1>> all = []()
  {
    std::vector<QGaussLobatto<1>> rules;
    for (unsigned int p = 1; p <= largest_degree; ++p)
      rules.emplace_back(p + 1);
    return rules;
  }();
  AssertThrow(degree >= 1 && degree <= largest_degree,
              ExcMessage("No edge has such a degree: " + std::to_string(degree)));
  return all[degree - 1];
}
} // namespace

/** The rule is exact to degree 2p - 1: what misses in the norm of P_p is known, 2/p for 2/(2p+1). */
EdgeBlend::EdgeBlend(const CurvePiece &curve, const std::function<Point<2>(double)> &way,
                     const Point<2> &a, const Point<2> &b, const unsigned int degree)
    : piece(curve), coefficients(degree + 1)
{
  const QGaussLobatto<1> &rule = nodes_of(degree);
  for (unsigned int i = 1; i < degree; ++i)
  {
    const double s = rule.point(i)[0];
    const Tensor<1, 2> blend = way(s) - (a + s * (b - a));
    const auto P = legendre(s, degree, 0)[0];
    for (unsigned int k = 0; k <= degree; ++k)
      coefficients[k] += rule.weight(i) * (k < degree ? 2. * k + 1 : degree) * P[k] * blend;
  }
}

EdgeBlend::operator bool() const
{
  return !coefficients.empty();
}

std::array<Tensor<1, 2>, 3> EdgeBlend::operator()(const double s, const unsigned int order) const
{
  const auto P = legendre(s, coefficients.size() - 1, order);
  std::array<Tensor<1, 2>, 3> result;
  for (unsigned int d = 0; d <= order; ++d)
    for (unsigned int k = 0; k < coefficients.size(); ++k)
      result[d] += P[d][k] * coefficients[k];
  return result;
}

const CurvePiece &EdgeBlend::curve() const
{
  return piece;
}
} // namespace hpvi
