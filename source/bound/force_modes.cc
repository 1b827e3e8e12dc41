// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/force_modes.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** By any rule: moments with polynomials as high as the element and psi take. */
Modes<2> projected_force(const Solution<2> &solution,
                         const DoFHandler<2>::active_cell_iterator &cell, const Tensor<2, 2> &B,
                         const double h, const unsigned int m, const Quadrature<2> &rule)
{
  const CellMap<2> map = map_of<2>(cell);
  const Tensor<2, 2> inverse = invert(B);
  const unsigned int n = m + 2;
  Modes<2> result(n);
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const Tensor<1, 2> f =
        -4 * rule.weight(q) * h *
        (inverse * load_at<2>(solution.scene.body_force_in(cell), map.point(rule.point(q))));
    const auto L_x = legendre::values(n, 2 * rule.point(q)[0] - 1),
               L_y = legendre::values(n, 2 * rule.point(q)[1] - 1);
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          result(k, i, j) += f[k] * L_x[i] * L_y[j];
  }
  return result;
}
} // namespace

Modes<2> force_modes(const Solution<2> &solution, const DoFHandler<2>::active_cell_iterator &cell,
                     const Tensor<2, 2> &B, const double h, const unsigned int m,
                     const LegendreTables &legendre)
{
  const LoadRule<2> rule = solution.spaces->loads->body_force(
      cell, solution.displacement_space.degrees()[cell->active_cell_index()]);
  const unsigned int n = rule.n_gauss;
  if (n == 0)
    return projected_force(solution, cell, B, h, m, rule.quadrature);
  const CellMap<2> map = map_of<2>(cell);
  const QGauss<1> &gauss = solution.tables.gauss(n);
  const Tensor<2, 2> inverse = invert(B);
  std::array<FullMatrix<double>, 2> values{{FullMatrix<double>(n, n), FullMatrix<double>(n, n)}};
  for (unsigned int a = 0; a < n; ++a)
    for (unsigned int b = 0; b < n; ++b)
    {
      const Tensor<1, 2> F = load_at<2>(solution.scene.body_force_in(cell),
                                        map.point(Point<2>(gauss.point(a)[0], gauss.point(b)[0])));
      const Tensor<1, 2> f = -h * (inverse * F);
      for (unsigned int k = 0; k < 2; ++k)
        values[k](a, b) = f[k];
    }
  const FullMatrix<double> &project = legendre.projection(n, n);
  FullMatrix<double> half(n, n), modes(n, n);
  Modes<2> result(n);
  for (unsigned int k = 0; k < 2; ++k)
  {
    project.mmult(half, values[k]);
    half.mTmult(modes, project);
    std::copy(&modes(0, 0), &modes(0, 0) + n * n, &result.coefficients[k * n * n]);
  }
  return result;
}

double missed_force(const Solution<2> &solution, const DoFHandler<2>::active_cell_iterator &cell,
                    const Tensor<2, 2> &B, const double h, const unsigned int m,
                    const Modes<2> &modes)
{
  const CellMap<2> map = map_of<2>(cell);
  const auto &loads = *solution.spaces->loads;
  const LoadRule<2> own =
      loads.body_force(cell, solution.displacement_space.degrees()[cell->active_cell_index()]);
  const Quadrature<2> rule = own.n_gauss > 0 ? Quadrature<2>(solution.tables.gauss(modes.n + 2))
                                             : loads.body_force(cell, m).quadrature;
  double sum = 0;
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const auto L_x = legendre::values(modes.n, 2 * rule.point(q)[0] - 1),
               L_y = legendre::values(modes.n, 2 * rule.point(q)[1] - 1);
    Tensor<1, 2> projected;
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int i = 0; i < std::min(modes.n, m - k); ++i)
        for (unsigned int j = 0; j < std::min(modes.n, m - 1 + k); ++j)
          projected[k] -= modes(k, i, j) * L_x[i] * L_y[j];
    const Tensor<1, 2> missed =
        load_at<2>(solution.scene.body_force_in(cell), map.point(rule.point(q))) -
        B * projected / h;
    sum += rule.weight(q) * missed.norm_square();
  }
  return std::sqrt(sum) * 2 * h;
}
} // namespace hpvi
