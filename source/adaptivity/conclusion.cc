// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/adaptivity/column_width.h>
#include <hpvi/adaptivity/conclusion.h>
#include <hpvi/base/processes.h>
#include <hpvi/checks/rejection.h>

namespace hpvi
{
template <int dim>
void conclude(const Backend<dim> &backend, const History<dim> &history, StepReport<dim> &step)
{
  const Adaptivity &limits = step.scene.adaptivity;
  step.largest_displacement = largest_displacement(step.field);
  std::vector<std::vector<StressSample<dim>>> peaks;
  for (const PastStep<dim> &past : history)
    peaks.push_back(past.peaks);
  step.unbounded = unbounded_stresses(growing_peaks(peaks), stress_samples(step.field), step.field);
  const BodyState<dim> body = body_state(step.field);
  Warnings of_all;
  together(backend.communicator,
           [&]() { of_all = warnings(step.scene, step.contact, body, history); });
  step.warnings =
      joined(contradiction_warnings(step.contradiction), of_all,
             backend.warnings(step.contact, step.equilibrium),
             tolerance_warnings(limits, history.back().relative_half_width, no_half_width(step)),
             step.bound ? bound_warnings(step.relative_bound, step.bound->imbalance) : Warnings());
  for (Warning &warning : step.warnings)
    warning.text = in_entries_of(step.scene, warning.text);
}

template void conclude(const Backend<2> &, const History<2> &, StepReport<2> &);
template void conclude(const Backend<3> &, const History<3> &, StepReport<3> &);
} // namespace hpvi
