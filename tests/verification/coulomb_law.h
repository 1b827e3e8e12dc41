// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_verification_coulomb_law_h
#define hpvi_verification_coulomb_law_h

#include "opening_contact.h"

#include <cmath>

namespace verification
{
/** What the last step of a run found. */
struct Outcome
{
  std::vector<double> elastic_energy; ///< 1/2 a(u,u), step by step
  ContactState<2> contact;
  std::vector<std::string> warnings;
  std::vector<double> effectivity; ///< step by step, where the exact solution is known
  std::vector<double> error;       ///< likewise, relative and in the energy norm
  double imbalance = 0;
};

/** |T_t| <= mu_f max(0, -T_n) at the points, slip against friction, u_n <= u_0 and z_n >= 0 in the moments. */
inline void expect_coulomb(const Solution<2> &solution)
{
  const auto &multipliers = solution.contact_space.multipliers();
  const Vector<double> Bu = solution.spaces->contact_operator.moments(solution.u);
  const double traction = solution.z.linfty_norm(), length = solution.u.linfty_norm();
  unsigned int n_cones = 0;
  for (unsigned int i = 0; i < multipliers.size(); ++i)
  {
    const double w = multipliers[i].weight, move = (Bu[i] - multipliers[i].gap) / w;
    if (multipliers[i].kind == ContactMultiplier<2>::Kind::pressure)
    {
      EXPECT_LE(std::abs(multipliers[i].is_bilateral ? move : std::max(move, 0.)), 1e-9 * length);
      if (multipliers[i].is_bilateral)
        continue;
      EXPECT_GE(solution.z[i], 0.);
      EXPECT_LE(std::abs(solution.z[i] * move), 1e-9 * traction * length);
      continue;
    }
    ++n_cones;
    ASSERT_LT(multipliers[i].partner, multipliers.size());
    const double bound = multipliers[i].friction.limit(solution.z[multipliers[i].partner]);
    EXPECT_EQ(bound, solution.contact_space.bound(i, solution.z));
    EXPECT_LE(std::abs(solution.z[i]), bound * (1 + 1e-14));
    // int g |u_t| = int z u_t, point by point
    EXPECT_LE(std::abs(bound * std::abs(move) - solution.z[i] * move), 1e-9 * traction * length);
  }
  EXPECT_GT(n_cones, 0u);
}

/** Without a bound. */
inline Outcome run(Scene<2> scene)
{
  Outcome outcome;
  scene.error_bound = false;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        expect_coulomb(step.solution());
        outcome.elastic_energy.push_back(step.energies.norm * step.energies.norm / 2);
        outcome.contact = step.contact.at(0);
        outcome.warnings = texts(step.warnings);
        outcome.effectivity.push_back(step.scaled_estimate / step.errors.energy);
        outcome.error.push_back(step.errors.energy / step.errors.energy_norm);
        outcome.imbalance =
            std::max(step.equilibrium.force_imbalance, step.equilibrium.moment_imbalance);
      });
  EXPECT_LE(outcome.imbalance, 1e-8);
  return outcome;
}

/** The displacement of a field on the left, right and top sides of a body. */
inline void prescribe(Scene<2> &scene, const std::function<Tensor<1, 2>(const Point<2> &)> &u)
{
  for (const std::string side : {"left", "right", "top"})
    for (const unsigned int c : {0U, 1U})
      scene.boundary(side).displacement[c] =
          expression<2>([=](const Point<2> &x) { return u(x)[c]; });
}
} // namespace verification

#endif
