// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/discretisation/initial_stress.h>
#include <hpvi/equilibration/initial_modes.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
using Values = std::array<FullMatrix<double>, 3>; ///< of xx, yy, xy at Gauss points

/** |stress - B known B'| in complementary energy, @p known by its modes; projection: LegendreTables::projection(). */
double missed(const Values &stresses, const Modes<3> &modes, const FullMatrix<double> &projection,
              const QGauss<1> &gauss, const Tensor<2, 2> &B, const HookesLaw<2> &law)
{
  const unsigned int n = projection.m(), n_gauss = gauss.size();
  FullMatrix<double> c(n, n), half(n, n_gauss);
  Values known;
  for (unsigned int k = 0; k < 3; ++k)
  {
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        c(i, j) = modes(k, i, j);
    c.mmult(half, projection); // which has the weights that the values lack
    known[k].reinit(n_gauss, n_gauss);
    projection.Tmmult(known[k], half);
  }
  double sum = 0, whole = 0;
  for (unsigned int a = 0; a < n_gauss; ++a)
    for (unsigned int b = 0; b < n_gauss; ++b)
    {
      const double weight = gauss.weight(a) * gauss.weight(b);
      Tensor<2, 2> stress, in_frame;
      for (unsigned int k = 0; k < 3; ++k)
      {
        stress[k == 1][k != 0] = stresses[k](a, b);
        in_frame[k == 1][k != 0] = known[k](a, b) / (4 * weight); // weights of [-1,1]
      }
      stress[1][0] = stress[0][1];
      in_frame[1][0] = in_frame[0][1];
      const Tensor<2, 2> left = stress - B * in_frame * transpose(B);
      sum += weight * law.complementary_product(left, left);
      whole += weight * law.complementary_product(stress, stress);
    }
  return sum <= 1e-26 * whole ? 0. : std::sqrt(sum); // or round-off
}
} // namespace

InitialModes initial_modes(const Solution<2> &solution,
                           const DoFHandler<2>::active_cell_iterator &cell, const Tensor<2, 2> &B,
                           const unsigned int n_whole, const unsigned int n,
                           const LegendreTables &legendre)
{
  InitialModes result{Modes<3>(n), 0.};
  if (!solution.scene.initial_strains[cell->material_id()])
    return result;
  const CellMap<2> map = map_of<2>(cell);
  const HookesLaw<2> law(solution.scene.material_of(cell));
  const unsigned int n_gauss = solution.displacement_space.strain_points(cell->active_cell_index());
  const QGauss<1> &gauss = solution.tables.gauss(n_gauss);
  const Tensor<2, 2> inverse = invert(B);
  Values stresses, in_frame;
  stresses.fill(FullMatrix<double>(n_gauss, n_gauss));
  in_frame = stresses;
  for (unsigned int a = 0; a < n_gauss; ++a)
    for (unsigned int b = 0; b < n_gauss; ++b)
    {
      const Point<2> x = map.point(Point<2>(gauss.point(a)[0], gauss.point(b)[0]));
      const Tensor<2, 2> stress(law.stress(solution.scene.initial_strain_in(cell, x))),
          s = inverse * stress * transpose(inverse);
      for (unsigned int k = 0; k < 3; ++k)
      {
        stresses[k](a, b) = stress[k == 1][k != 0];
        in_frame[k](a, b) = s[k == 1][k != 0];
      }
    }
  const unsigned int known = std::min(n_gauss, n_whole);
  const FullMatrix<double> &project = legendre.projection(known, n_gauss);
  FullMatrix<double> half(known, n_gauss), modes(known, known);
  for (unsigned int k = 0; k < 3; ++k)
  {
    project.mmult(half, in_frame[k]);
    half.mTmult(modes, project);
    for (unsigned int i = 0; i < known; ++i)
      for (unsigned int j = 0; j < known; ++j)
        result.modes(k, i, j) = modes(i, j);
  }
  // By quadrature at the points of the discrete equations, which is exact for the polynomial that these know.
  result.missed = std::sqrt(std::abs(determinant(map.jacobian(Point<2>(0.5, 0.5))))) *
                  missed(stresses, result.modes, project, gauss, B, law);
  return result;
}
} // namespace hpvi
