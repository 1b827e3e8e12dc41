// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/initial_modes.h>
#include <hpvi/plane/initial_stress.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A symmetric matrix by xx, yy, xy. */
Tensor<2, 2> symmetric(const double xx, const double yy, const double xy)
{
  Tensor<2, 2> result;
  result[0][0] = xx;
  result[1][1] = yy;
  result[0][1] = result[1][0] = xy;
  return result;
}
} // namespace

InitialModes initial_modes(const Solution<2> &solution,
                           const DoFHandler<2>::active_cell_iterator &cell, const Tensor<2, 2> &B,
                           const unsigned int n_whole, const unsigned int n)
{
  InitialModes result{Modes<3>(n), 0.};
  if (!solution.scene.initial_strains[cell->material_id()])
    return result;
  const unsigned int degree = solution.displacement_space.degrees()[cell->active_cell_index()];
  const LoadRule<2> rule = solution.spaces->loads->initial_strain(cell, degree);
  unsigned int known = n_whole;
  for (const RulePart<2> &part : rule.parts) // beyond these the polynomials on parts know nothing
    known = std::min(known, part.n);
  const CellMap<2> map = map_of<2>(cell);
  const HookesLaw<2> law(solution.scene.material_of(cell));
  const Tensor<2, 2> inverse = invert(B);
  const std::vector<Point<2>> &points = rule.quadrature.get_points();
  std::vector<Tensor<2, 2>> stresses;
  FullMatrix<double> L_x(points.size(), known), L_y(L_x);
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    const auto of_x = legendre::values(known, 2 * points[q][0] - 1),
               of_y = legendre::values(known, 2 * points[q][1] - 1);
    std::copy(of_x.begin(), of_x.end(), &L_x(q, 0));
    std::copy(of_y.begin(), of_y.end(), &L_y(q, 0));
    stresses.emplace_back(law.stress(solution.scene.initial_strain_in(cell, map.point(points[q]))));
    const Tensor<2, 2> s =
        4 * rule.quadrature.weight(q) * (inverse * stresses[q] * transpose(inverse));
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < known; ++i)
        for (unsigned int j = 0; j < known; ++j)
          result.modes(k, i, j) += s[k == 1][k != 0] * L_x(q, i) * L_y(q, j);
  }
  // By quadrature at the points of the discrete equations, which is exact for the polynomials that these know.
  double missed = 0, whole = 0;
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    std::array<double, 3> seen{};
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < known; ++i)
        for (unsigned int j = 0; j < known; ++j)
          seen[k] += result.modes(k, i, j) * L_x(q, i) * L_y(q, j);
    const Tensor<2, 2> left = stresses[q] - B * symmetric(seen[0], seen[1], seen[2]) * transpose(B);
    missed += rule.quadrature.weight(q) * law.complementary_product(left, left);
    whole += rule.quadrature.weight(q) * law.complementary_product(stresses[q], stresses[q]);
  }
  if (missed > 1e-26 * whole) // or round-off
    result.missed = std::sqrt(std::abs(determinant(map.jacobian(Point<2>(0.5, 0.5)))) * missed);
  return result;
}
} // namespace hpvi
