// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_late_bound_h
#define hpvi_late_bound_h

#include <hpvi/driver/step_report.h>
#include <hpvi/results/warnings/history.h>

namespace hpvi
{
/**
 * Scene::error_bound_last: may the bound of the last step of @p history, which is not known yet, say that the
 * tolerance is met? As long as no step has a bound, or a half-width where the tolerance is on one, it may: that of
 * the coarse mesh costs nothing. Then it is taken to fall with the indicator,
 *
 *     bound = indicator * (bound/indicator of the last step that has both),
 *
 * and may be less than that by a third. Never where the tolerance asks for neither.
 */
template <int dim>
bool may_meet_tolerance(const Scene<dim> &scene, const History<dim> &history);

/** What stands for it as long as it is not known. */
BoundOfStep open_bound();

/** @p part over @p whole, which may be zero and has no parts then. */
double part_of(double part, double whole);

/** Puts @p bound into the report of its step, and what limits ask of it into @p past. */
template <int dim>
void take_bound(const BoundOfStep &bound, StepReport<dim> &step, PastStep<dim> &past);
} // namespace hpvi

#endif
