// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/processes.h>
#include <hpvi/driver/column_width.h>
#include <hpvi/driver/conclusion.h>
#include <hpvi/reader/checks/rejection.h>

#include <algorithm>

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
  const std::vector<StressSample<dim>> samples = stress_samples(step.field);
  std::vector<StressSample<dim>> growing = growing_peaks(peaks);
  // The mesh comes from load steps before; on one process, for peaks of others are not known alike on all.
  if (backend.trail().size() >= history.size() && n_processes(backend.communicator) == 1)
    for (const StressSample<dim> &peak : peaks_of_rings(step.peaks, samples, step.field))
      if (std::none_of(growing.begin(), growing.end(),
                       [&](const auto &known)
                       { return known.boundary == peak.boundary && known.where == peak.where; }))
        growing.push_back(peak);
  step.unbounded = unbounded_stresses(growing, samples, step.field);
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
