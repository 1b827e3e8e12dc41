// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/corner_stress.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
using Components = std::array<double, 3>;

/** c(t) with c(0) = 1, c(1) = c'(1) = 0, its first and second derivative: of degree 4 where tractions may be. */
std::array<double, 3> cut_off(const unsigned int m, const double t)
{
  if (m < 5)
    return {{(1 - t) * (1 - t), -2 * (1 - t), 2.}};
  const double e = 1 - t * t;
  return {{e * e, -4 * e * t, 8 * t * t - 4 * e}};
}

/** The second derivatives of `r^2 F(theta) c(x) c(y)` that make its stress, x and y in [0,1] from the corner. */
Components corner_stress_from_corner(const unsigned int m, const double x, const double y)
{
  const double theta = std::atan2(y, x), D = numbers::PI / 4, r2 = x * x + y * y;
  const double P = -r2 * theta - x * y - D * (x * x - y * y) + D * r2;
  const double Px = -2 * x * theta, Py = -2 * y * theta - 2 * x + 4 * D * y;
  const double xy = r2 > 0 ? x * y / r2 : 0., cosine = r2 > 0 ? (x * x - y * y) / r2 : 1.;
  const double Pxx = -2 * theta + 2 * xy, Pyy = -2 * theta - 2 * xy + 4 * D, Pxy = -cosine - 1;
  const auto c = cut_off(m, x), d = cut_off(m, y);
  return {{(Pyy * d[0] + 2 * Py * d[1] + P * d[2]) * c[0],
           (Pxx * c[0] + 2 * Px * c[1] + P * c[2]) * d[0],
           -(Pxy * c[0] * d[0] + Px * c[0] * d[1] + Py * c[1] * d[0] + P * c[1] * d[1])}};
}
} // namespace

std::array<double, 3> corner_stress(const unsigned int m, const unsigned int corner,
                                    const double xi, const double eta)
{
  const bool right = corner % 2, top = corner / 2;
  Components s = corner_stress_from_corner(m, right ? (1 - xi) / 2 : (1 + xi) / 2,
                                           top ? (1 - eta) / 2 : (1 + eta) / 2);
  s[2] *= right != top ? -1 : 1;
  return s;
}

Quadrature<2> corner_quadrature(const std::vector<unsigned int> &corners,
                                const unsigned int n_gauss)
{
  const QGauss<1> gauss(n_gauss);
  const bool is_one = corners.size() == 1;
  const double side = is_one ? 1. : 0.5;
  std::vector<Point<2>> points;
  std::vector<double> weights;
  for (unsigned int corner = 0; corner < 4; ++corner)
    for (unsigned int a = 0; (!is_one || corner == corners[0]) && a < n_gauss; ++a)
      for (unsigned int b = 0; b < n_gauss; ++b)
      {
        const double u = side * gauss.point(a)[0], v = u * gauss.point(b)[0];
        for (const auto &[x, y] : {std::make_pair(u, v), std::make_pair(v, u)})
        {
          points.emplace_back(corner % 2 ? 1 - x : x, corner / 2 ? 1 - y : y);
          weights.push_back(side * u * gauss.weight(a) * gauss.weight(b));
        }
      }
  return Quadrature<2>(points, weights);
}
} // namespace hpvi
