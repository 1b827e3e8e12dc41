// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/stop_reason.h>
#include <hpvi/reader/scene_reader.h>

namespace hpvi
{
std::string stop_reason(const std::string &stopped_by, const Adaptivity &adaptivity,
                        const bool has_bound)
{
  if (stopped_by == "round-off")
    return "stopped: exact to round-off";
  if (stopped_by == "Adapt = first step")
    return "solved once, as Loading/Adapt = first step says";
  if (stopped_by == "Tolerance" && !adaptivity.tolerance_column.empty())
    return "done: " + adaptivity.tolerance_column +
           " is guaranteed to Adaptivity/Tolerance of its value";
  if (stopped_by == "Tolerance" && adaptivity.is_default_tolerance)
    return std::string("done: the error ") +
           (has_bound && adaptivity.tolerance_on == Indicator::bound ? "" : "indicator ") +
           "is below " + default_tolerance + ", the default of Adaptivity/Tolerance";
  const bool is_entry = stopped_by.find("error of load step") == std::string::npos;
  return "stopped by " + (is_entry ? "Adaptivity/" + stopped_by : "the " + stopped_by);
}
} // namespace hpvi
