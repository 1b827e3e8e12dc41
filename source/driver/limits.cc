// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/finite.h>
#include <hpvi/base/text.h>
#include <hpvi/driver/limits.h>
#include <hpvi/plane/negligible_solution.h>

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
void check_underflow(const Scene<dim> &scene, const double largest)
{
  const double negligible =
      std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
  for (const Material &material : scene.materials) // the softest part may hold it all
    if (largest > 0 && material.modulus(dim) * largest * largest < negligible)
      throw NumericalFailure("the energy underflows: " + material.stiffness_in_words(dim) +
                             " and displacements up to " + to_string(largest) +
                             "; choose units in which loads are moderate");
}

/** May the last step of @p history be nothing but round-off: strained by less than its indicator, which falls no further? */
template <int dim>
bool says_nothing(const History<dim> &history)
{
  const PastStep<dim> &step = history.back();
  return step.relative_estimate > 1 ||
         (history.size() > 1 && step.estimate > 0.9 * history[history.size() - 2].estimate);
}

/**
 * Is the indicator no more than that of round-off in u_N, and likewise what it does not see of the data? Where it is,
 * refinement goes on for nothing. Asked only where it is small, because it costs an indicator. The bits that a factorisation
 * loses are more than the last ones, on curves, at high degrees and in pairs up to some dozen times: there the indicator
 * itself has to say that refinement gains nothing. What is round-off beside load steps before is so whatever its digits are.
 */
template <int dim>
bool is_exact_to_round_off(const Scene<dim> &scene, const History<dim> &history,
                           const LastSolution &last)
{
  const double small = 1e-7 * scene.largest_weight() * last.displacement,
               coercivity = scene.reference_coercivity(),
               larger = std::max(history.back().estimate, last.missed * std::sqrt(coercivity));
  const bool is_small =
      larger * larger <= coercivity * negligible_energy(scene) ||
      (larger <= small && larger <= (says_nothing(history) ? 100 : 4) * last.round_off());
  return is_small && last.resolves_data();
}
} // namespace

void check_algebraic_error(const AlgebraicError &error, const double negligible)
{
  // of the largest solution so far
  const double largest =
      std::max(error.energy_product, negligible / (round_off_of_data * round_off_of_data));
  if (error.total() * std::sqrt(error.energy_product / largest) <= AlgebraicError::useless ||
      error.total() == 0.)
    return;
  std::ostringstream line;
  line
      << "round-off spoils the solution: its relative error is about " << error.total() << " after "
      << error.corrections
      << " corrections; the body is too slender or its supports are too weak for double precision: "
         "support it better, or choose fewer Geometry/Subdivisions and a higher degree";
  throw NumericalFailure(line.str());
}

template <int dim>
void check_numbers(const Scene<dim> &scene, const double displacement, const Energies &energies)
{
  const double stress = scene.materials[0].modulus(dim) * displacement;
  check_finite("the energy", energies.energy, stress);
  check_finite("the Lagrangian", energies.lagrangian, stress);
  check_finite("the energy norm", energies.norm, stress);
  check_underflow(scene, displacement);
}

template <int dim>
Stop reached_limit(const Scene<dim> &scene, const History<dim> &history, const LastSolution &last)
{
  const Adaptivity &limits = scene.adaptivity;
  const PastStep<dim> &step = history.back();
  if (is_exact_to_round_off(scene, history, last))
    return Stop::round_off;
  const bool on_bound = limits.tolerance_on == Indicator::bound &&
                        (last.is_bound_open || !std::isnan(step.relative_bound));
  const double error = !limits.tolerance_column.empty() ? step.relative_half_width
                       : on_bound                       ? step.relative_bound
                                                        : step.relative_estimate;
  if (error < limits.tolerance && last.resolves_data()) // never without half-width, or bound yet
    return Stop::tolerance;
  if (history.size() >= limits.maximum_steps)
    return Stop::maximum_steps;
  if (last.n_free >= limits.maximum_unknowns)
    return Stop::maximum_unknowns;
  if (limits.maximum_seconds > 0 && step.seconds >= limits.maximum_seconds)
    return Stop::maximum_seconds;
  return Stop::none;
}

template void check_numbers(const Scene<2> &, double, const Energies &);
template void check_numbers(const Scene<3> &, double, const Energies &);
template Stop reached_limit(const Scene<2> &, const History<2> &, const LastSolution &);
template Stop reached_limit(const Scene<3> &, const History<3> &, const LastSolution &);
} // namespace hpvi
