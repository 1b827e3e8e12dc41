// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/adaptivity/limits.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/evaluation/residual_estimator.h>
#include <hpvi/scene/data_scale.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Energies are squares, of which a small solution would leave zero. */
template <int dim>
void check_underflow(const Solution<dim> &solution)
{
  const double largest = solution.u.linfty_norm();
  const double negligible =
      std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
  for (const Material &material : solution.scene.materials) // the softest part may hold it all
    if (largest > 0 && material.young * largest * largest < negligible)
      throw NumericalFailure("the energy underflows: Young's modulus " + to_string(material.young) +
                             " and displacements up to " + to_string(largest) +
                             "; choose units in which loads are moderate");
}

void check_algebraic_error(const AlgebraicError &error)
{
  if (error.total() <= AlgebraicError::useless)
    return;
  std::ostringstream line;
  line
      << "round-off spoils the solution: its relative error is about " << error.total() << " after "
      << error.corrections
      << " corrections; the body is too slender or its supports are too weak for double precision: "
         "support it better, or choose fewer Geometry/Subdivisions and a higher degree";
  throw NumericalFailure(line.str());
}

/**
 * Is the indicator no more than that of round-off in u_N, and likewise what it does not see of the data? Where it is,
 * refinement goes on for nothing. Asked only where it is small, because it costs an indicator.
 */
template <int dim>
bool is_exact_to_round_off(const Solution<dim> &solution, const double estimate,
                           const double missed)
{
  const double largest =
                   std::max(solution.u.linfty_norm(), data_scale(solution.scene).displacement),
               small = 1e-7 * solution.scene.largest_mu() * largest,
               larger = std::max(estimate, missed * std::sqrt(solution.scene.coercivity()));
  return larger <= small && larger <= 4 * round_off_of_estimate(solution);
}
} // namespace

template <int dim>
void check_numbers(const Solution<dim> &solution, const Energies &energies,
                   const AlgebraicError &algebraic)
{
  check_finite("the energy", energies.energy);
  check_finite("the Lagrangian", energies.lagrangian);
  check_finite("the energy norm", energies.norm);
  check_underflow(solution);
  check_algebraic_error(algebraic);
}

template <int dim>
std::string reached_limit(const Solution<dim> &solution, const History &history,
                          const double missed)
{
  const Adaptivity &limits = solution.scene.adaptivity;
  const PastStep &last = history.back();
  if (is_exact_to_round_off(solution, last.estimate, missed))
    return "round-off";
  const bool on_bound = limits.tolerance_on == Indicator::bound && !std::isnan(last.relative_bound);
  if ((on_bound ? last.relative_bound : last.relative_estimate) < limits.tolerance)
    return "Tolerance";
  if (history.size() >= limits.maximum_steps)
    return "Maximum steps";
  if (solution.displacement_space.n_free_dofs() >= limits.maximum_unknowns)
    return "Maximum unknowns";
  if (limits.maximum_seconds > 0 && last.seconds >= limits.maximum_seconds)
    return "Maximum seconds";
  return {};
}

template void check_numbers(const Solution<2> &, const Energies &, const AlgebraicError &);
template std::string reached_limit(const Solution<2> &, const History &, double);
} // namespace hpvi
