// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/stop_reason.h>
#include <hpvi/reader/scene_reader.h>

namespace hpvi
{
std::string stop_reason(const StopReason &stopped_by, const Adaptivity &adaptivity,
                        const bool has_bound, const bool by_coupling)
{
  const Stop stop = stopped_by.stop;
  if (stop == Stop::round_off)
    return "stopped: exact to round-off";
  if (stop == Stop::first_step)
    return "solved once, as Loading/Adapt = first step says";
  if (stop == Stop::tolerance && adaptivity.tolerance_column == equilibrated_estimate)
    return "done: the error, estimated by a stress in equilibrium, is below Adaptivity/Tolerance";
  if (stop == Stop::tolerance && !adaptivity.tolerance_column.empty())
    return "done: " + adaptivity.tolerance_column +
           (by_coupling ? ", if the coupling is as estimated, is known" : " is guaranteed") +
           " to Adaptivity/Tolerance of its value";
  if (stop == Stop::tolerance && adaptivity.is_default_tolerance)
    return std::string("done: the error ") +
           (has_bound && by_coupling && adaptivity.tolerance_on == Indicator::bound
                ? "bound, if the coupling is as estimated, "
                : "") +
           (has_bound && adaptivity.tolerance_on == Indicator::bound ? "" : "indicator ") +
           "is below " + default_tolerance + ", the default of Adaptivity/Tolerance";
  return "stopped by " + std::string(stop == Stop::load_step ? "the " : "Adaptivity/") +
         text(stopped_by);
}
} // namespace hpvi
