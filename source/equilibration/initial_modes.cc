// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/discretisation/initial_stress.h>
#include <hpvi/equilibration/initial_modes.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

Modes<3> initial_modes(const Solution<2> &solution, const DoFHandler<2>::active_cell_iterator &cell,
                       const Tensor<2, 2> &B, const unsigned int n_whole, const unsigned int n,
                       const LegendreTables &legendre)
{
  if (!solution.scene.initial_strains[cell->material_id()])
    return Modes<3>(n);
  const CellMap<2> map = map_of<2>(cell);
  const HookesLaw<2> law(solution.scene.material_of(cell));
  const unsigned int n_gauss = solution.displacement_space.strain_points(cell->active_cell_index());
  const QGauss<1> &gauss = solution.tables.gauss(n_gauss);
  const Tensor<2, 2> inverse = invert(B);
  std::array<FullMatrix<double>, 3> values;
  values.fill(FullMatrix<double>(n_gauss, n_gauss));
  for (unsigned int a = 0; a < n_gauss; ++a)
    for (unsigned int b = 0; b < n_gauss; ++b)
    {
      const Point<2> x = map.point(Point<2>(gauss.point(a)[0], gauss.point(b)[0]));
      const Tensor<2, 2> stress(law.stress(solution.scene.initial_strain_in(cell, x))),
          s = inverse * stress * transpose(inverse);
      for (unsigned int k = 0; k < 3; ++k)
        values[k](a, b) = s[k == 1][k != 0];
    }
  const unsigned int known = std::min(n_gauss, n_whole);
  const FullMatrix<double> &project = legendre.projection(known, n_gauss);
  FullMatrix<double> half(known, n_gauss), modes(known, known);
  Modes<3> result(n);
  for (unsigned int k = 0; k < 3; ++k)
  {
    project.mmult(half, values[k]);
    half.mTmult(modes, project);
    for (unsigned int i = 0; i < known; ++i)
      for (unsigned int j = 0; j < known; ++j)
        result(k, i, j) = modes(i, j);
  }
  return result;
}

/** By quadrature at the points of the discrete equations, which is exact for the polynomial that these know. */
double missed_initial_modes(const Solution<2> &solution,
                            const DoFHandler<2>::active_cell_iterator &cell, const Tensor<2, 2> &B,
                            const unsigned int n_whole, const Modes<3> &modes)
{
  if (!solution.scene.initial_strains[cell->material_id()])
    return 0.;
  const CellMap<2> map = map_of<2>(cell);
  const HookesLaw<2> law(solution.scene.material_of(cell));
  const QGauss<2> rule(solution.displacement_space.strain_points(cell->active_cell_index()));
  double sum = 0, whole = 0;
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const Point<2> &s = rule.point(q);
    const auto L_x = legendre::values(n_whole, 2 * s[0] - 1),
               L_y = legendre::values(n_whole, 2 * s[1] - 1);
    Tensor<2, 2> known;
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < n_whole; ++i)
        for (unsigned int j = 0; j < n_whole; ++j)
          known[k == 1][k != 0] += modes(k, i, j) * L_x[i] * L_y[j];
    known[1][0] = known[0][1];
    const Tensor<2, 2> stress(law.stress(solution.scene.initial_strain_in(cell, map.point(s)))),
        missed = stress - B * known * transpose(B);
    sum += rule.weight(q) * law.complementary_product(missed, missed);
    whole += rule.weight(q) * law.complementary_product(stress, stress);
  }
  const double area = std::abs(determinant(map.jacobian(Point<2>(0.5, 0.5))));
  return sum <= 1e-26 * whole ? 0. : std::sqrt(area * sum); // or round-off
}
} // namespace hpvi
