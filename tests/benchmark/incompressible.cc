// SPDX-License-Identifier: LGPL-2.1-or-later
// What the stress in equilibrium and the error are made of near incompressibility, as a table: with the pressure of u_N,
// and with that of the mixed method. ./run incompressible.
#include <hpvi/bound/admissible_friction.h>
#include <hpvi/bound/equilibrated_stress.h>
#include <hpvi/bound/mixed_problem.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/reader/scene_reader.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace
{
using namespace dealii;
using namespace hpvi;

/** `|dev s|^2/(2 mu)` and `tr(s)^2/(4 (lambda + mu))`: shear and volume of the energy of a stress in the plane. */
std::array<double, 2> parts(const SymmetricTensor<2, 2> &s, const Material &material)
{
  const double mu = material.mu(), lambda = material.lambda(2), tr = trace(s);
  return {{(s * s - tr * tr / 2) / (2 * mu), tr * tr / (4 * (lambda + mu))}};
}

/** s - sigma(u_N) and sigma(u) - sigma(u_N) by 24 x 24 Gauss points a cell: squares by part. */
std::array<std::array<double, 2>, 2> squares(const Solution<2> &solution,
                                             const EquilibratedStress &stress)
{
  std::array<std::array<double, 2>, 2> sums{};
  const QGauss<2> gauss(24);
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
  {
    const unsigned int index = cell->active_cell_index();
    const CellMap<2> map = map_of<2>(cell);
    const Material &material = solution.scene.material_of(cell);
    const HookesLaw<2> law(material);
    const Tensor<2, 2> J = map.jacobian({0.5, 0.5}), B = stress.frame(index);
    const StressElement::Stress s = stress.stress(index);
    const ShapeTable<2> table = tabulate<2>(solution.displacement_space.degrees()[index],
                                            gauss.get_points(), gauss.get_weights(), false);
    const std::vector<double> d = evaluate(table.derivatives, solution.coefficients(index));
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const Point<2> xi = gauss.point(q);
      Tensor<2, 2> reference, S;
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int j = 0; j < 2; ++j)
          reference[c][j] = d[(c * gauss.size() + q) * 2 + j];
      const auto value = s.value(2 * xi[0] - 1, 2 * xi[1] - 1);
      S[0][0] = value[0];
      S[1][1] = value[1];
      S[0][1] = S[1][0] = value[2];
      const SymmetricTensor<2, 2> of_u_N = law.stress(reference * invert(J)),
                                  of_s(symmetrize(B * S * transpose(B))),
                                  of_u = law.stress(
                                      solution.scene.exact_solution->gradient(map.point(xi)));
      for (const unsigned int what : {0, 1})
      {
        const auto part = parts((what == 0 ? of_s : of_u) - of_u_N, material);
        for (const unsigned int k : {0, 1})
          sums[what][k] += gauss.weight(q) * determinant(J) * part[k];
      }
    }
  }
  return sums;
}

double eta(const EquilibratedStress &stress)
{
  return std::sqrt(std::accumulate(stress.squares.begin(), stress.squares.end(), 0.));
}

/** In equilibrium by a solution of the discrete equations, measured from u_N. */
EquilibratedStress equilibrated(const Solution<2> &balanced, const Solution<2> &u_N,
                                const Volume volume, EquilibrationCache &cache)
{
  const AdmissibleFriction<2> friction(balanced);
  return EquilibratedStress(
      balanced,
      [&](const unsigned int face, const unsigned int end)
      { return friction.part(face, end).coefficients(); },
      {}, cache, &u_N, volume);
}
} // namespace

int main()
try
{
  std::printf("nu,method,degree,dofs_free,error,eta,eta_of_u_N,error_shear,shear_of_u_N\n");
  for (const std::string nu : {"0.3", "0.4999", "0.499999"})
    for (const std::string method : {"hup2", "pu"})
    {
      const Scene<2> scene =
          read_scene<2>("prm/plane-strain.prm", {{"Material/Poisson's ratio", nu},
                                                 {"Adaptivity/Method", method},
                                                 {"Adaptivity/Start degree", "2"},
                                                 {"Adaptivity/Maximum steps", "5"}});
      EquilibrationCache cache;
      MixedProblem mixed(scene);
      AdaptiveSolver<2>(scene).run(
          [&](const StepReport<2> &step)
          {
            const Solution<2> &u_N = step.solution();
            std::unique_ptr<LinearSolver> none;
            const EquilibratedStress own = equilibrated(u_N, u_N, Volume::full, cache),
                                     stress = equilibrated(mixed.solve(u_N, none), u_N,
                                                           Volume::projected, cache);
            const auto sums = squares(u_N, own);
            std::printf("%s,%s,%u,%u,%.4e,%.4e,%.4e,%.4e,%.4e\n", nu.c_str(), method.c_str(),
                        u_N.displacement_space.degrees()[0], u_N.displacement_space.n_free_dofs(),
                        step.errors.energy, eta(stress), eta(own), std::sqrt(sums[1][0]),
                        std::sqrt(sums[0][0]));
          });
    }
  return 0;
}
catch (const std::exception &error)
{
  std::fprintf(stderr, "incompressible: %s\n", error.what());
  return 1;
}
