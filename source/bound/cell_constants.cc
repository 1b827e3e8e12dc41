// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/cell_constants.h>
#include <hpvi/bound/edge_polynomial.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
unsigned int start(const unsigned int face) ///< first vertex
{
  return face < 2 ? face : 2 * (face - 2);
}

/**
 * Numbers between which polynomials on the unit cell are, of degree @p n in each variable, from Chebyshev points as EdgePolynomial::enclosure()
 * is; @p function has all of them at a point.
 */
template <std::size_t n_functions, class Function>
std::array<std::pair<double, double>, n_functions> enclosures(const unsigned int n,
                                                              const Function &function)
{
  const unsigned int m = 3 * n;
  std::array<std::pair<double, double>, n_functions> result;
  std::array<double, n_functions> values = function(Point<2>(0.5, 0.5));
  for (unsigned int k = 0; k < n_functions; ++k)
    result[k] = {values[k], values[k]};
  const auto place = [m](const unsigned int i)
  { return 0.5 - 0.5 * std::cos((i + 0.5) * numbers::PI / m); };
  for (unsigned int a = 0; a < m; ++a)
    for (unsigned int b = 0; b < m; ++b)
    {
      values = function(Point<2>(place(a), place(b)));
      for (unsigned int k = 0; k < n_functions; ++k)
        result[k] = {std::min(result[k].first, values[k]), std::max(result[k].second, values[k])};
    }
  const double wider = 1 / std::pow(std::cos(numbers::PI / 6), 2);
  for (auto &[low, high] : result)
  {
    const double middle = (low + high) / 2, half = wider * (high - low) / 2;
    low = middle - half;
    high = middle + half;
  }
  return result;
}

/** Of the map in each variable. */
unsigned int degree_of(const CellMap<2> &map)
{
  unsigned int result = 1;
  for (const EdgeBlend &blend : map.blends())
    if (blend)
      result = std::max(result, blend.degree());
  return result;
}
} // namespace

CellConstants::CellConstants(const CellMap<2> &map) : map(map), centre(map.point({0.5, 0.5}))
{
  const CellMap<2>::Vertices &v = map.vertices();
  for (unsigned int i = 0; i < 4; ++i)
  {
    outer = std::max(outer, centre.distance(v[i]));
    for (unsigned int j = 0; j < i; ++j)
      diameter = std::max(diameter, v[i].distance(v[j]));
  }
  for (unsigned int face = 0; face < 4; ++face)
    if (map.is_curved() && map.blends()[face])
      look_at(face);
    else
      inner[face] = distance(centre, face);
}

/** A curved edge in sixteen pieces, on each of which `((x - c) x x')^2/|x'|^2` has the least of one over the largest of the other. */
void CellConstants::look_at(const unsigned int face)
{
  constexpr unsigned int n_pieces = 16;
  const unsigned int degree = map.blends()[face].degree();
  const QGauss<1> gauss(2 * degree + 1);
  inner[face] = diameter;
  for (unsigned int piece = 0; piece < n_pieces; ++piece)
  {
    std::vector<double> cross_product, speed, distances;
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const Point<2> at = point_on_face<2>(face, Point<1>((piece + gauss.point(q)[0]) / n_pieces));
      const Tensor<1, 2> x = map.point(at) - centre,
                         along = map.jacobian(at) *
                                 Tensor<1, 2>({face < 2 ? 0. : 1., face < 2 ? 1. : 0.});
      const double turn = face == 1 || face == 2 ? 1. : -1.;
      cross_product.push_back(turn * (x[0] * along[1] - x[1] * along[0]));
      speed.push_back(along.norm_square());
      distances.push_back(x.norm_square());
    }
    const auto through = [&](const std::vector<double> &values)
    { return EdgePolynomial::through(values, gauss).enclosure(); };
    inner[face] =
        std::min(inner[face], through(cross_product).first / std::sqrt(through(speed).second));
    outer = std::max(outer, std::sqrt(through(distances).second));
  }
}

double CellConstants::distance(const Point<2> &x, const unsigned int face) const
{
  const Point<2> &a = map.vertices()[start(face)],
                 &b = map.vertices()[start(face) + (face < 2 ? 2 : 1)];
  return std::abs((b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0])) / a.distance(b);
}

bool CellConstants::is_star_shaped() const
{
  return *std::min_element(inner.begin(), inner.end()) > 0;
}

double CellConstants::poincare() const
{
  if (!map.is_curved())
    return diameter / numbers::PI;
  const auto [det, xx, xy, yx, yy] = enclosures<5>(
      2 * degree_of(map),
      [&](const Point<2> &x)
      {
        const Tensor<2, 2> J = map.jacobian(x);
        return std::array<double, 5>{{determinant(J), J[0][0], J[0][1], J[1][0], J[1][1]}};
      });
  double norm = 0;
  for (const auto &[low, high] : {xx, xy, yx, yy})
    norm += std::pow(std::max(std::abs(low), std::abs(high)), 2);
  return 1 / numbers::PI * std::sqrt(det.second / std::max(0., det.first) * norm);
}

double CellConstants::korn() const
{
  const double x = *std::min_element(inner.begin(), inner.end()) / outer;
  return 2 / x * std::sqrt(1 + std::sqrt(std::max(0., 1 - x * x)));
}

double CellConstants::antisymmetry(const Material &material) const
{
  return std::sqrt((korn() * korn() - 1) / 2 / material.coercivity(2));
}

double CellConstants::trace(const unsigned int face) const
{
  if (map.is_curved())
  {
    const double C = poincare();
    return std::sqrt(2 * C * (C + outer) / inner[face]);
  }
  const CellMap<2>::Vertices &v = map.vertices();
  const unsigned int a = start(face), step = face < 2 ? 1 : 2;
  if (map.is_affine())
  {
    const double across = v[0].distance(v[step]);
    return std::sqrt((poincare() + 2 * across) * poincare() / distance(v[start(face ^ 1)], face));
  }
  const Point<2> apex = point_on_face<2>(face ^ 1, Point<1>(0.5)), P = map.point(apex);
  const double reach = std::max(P.distance(v[a]), P.distance(v[a + 3 - step]));
  return std::sqrt(2 * (poincare() + reach) * poincare() / distance(P, face));
}
} // namespace hpvi
