// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/driver/late_bound.h>

#include <cmath>

namespace hpvi
{
namespace
{
/**
 * One bound in vain costs less than a step in vain. Of 1055 runs on a dozen scenes, by all methods and to tolerances
 * from 3e-2 to 6e-6, one in fifty takes a step more than it needs; on average 1.4 bounds stand beside that of the
 * coarse mesh.
 */
constexpr double margin = 1.5;
} // namespace

template <int dim>
bool may_meet_tolerance(const Scene<dim> &scene, const History<dim> &history)
{
  const Adaptivity &limits = scene.adaptivity;
  const bool on_width = !limits.tolerance_column.empty();
  if (limits.tolerance == 0 || !(on_width || limits.tolerance_on == Indicator::bound))
    return false;
  const double estimate = history.back().relative_estimate;
  for (auto past = history.rbegin() + 1; past < history.rend(); ++past)
    if (const double error = on_width ? past->relative_half_width : past->relative_bound;
        std::isfinite(error))
      return estimate * error < margin * limits.tolerance * past->relative_estimate;
  return true;
}

BoundOfStep open_bound()
{
  BoundOfStep result;
  result.missing = "Error/Bound = last step, and this is none";
  return result;
}

double part_of(const double part, const double whole)
{
  return part == 0 ? 0. : part / whole;
}

template <int dim>
void take_bound(const BoundOfStep &bound, StepReport<dim> &step, PastStep<dim> &past)
{
  step.bound = bound.bound;
  step.energy_high = bound.energy_high;
  step.bound_imbalance = bound.imbalance;
  if (bound.bound)
  {
    past.relative_bound = part_of(bound.bound->total, step.energies.norm);
    past.own_stress = bound.bound->own_stress;
  }
  step.relative_bound = past.relative_bound;
}

template bool may_meet_tolerance(const Scene<2> &, const History<2> &);
template bool may_meet_tolerance(const Scene<3> &, const History<3> &);
template void take_bound(const BoundOfStep &, StepReport<2> &, PastStep<2> &);
template void take_bound(const BoundOfStep &, StepReport<3> &, PastStep<3> &);
} // namespace hpvi
