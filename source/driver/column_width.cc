// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/driver/column_width.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
namespace
{
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/** The probe that has the column, or is it. */
template <int dim>
const ProbeValue<dim> *probe_of(const StepReport<dim> &step, const std::string &column)
{
  for (const ProbeValue<dim> &value : step.probes)
  {
    const Probe<dim> &probe = step.scene.probes[value.probe];
    const std::vector<std::string> columns = columns_of(probe);
    if (probe.name == column || std::find(columns.begin(), columns.end(), column) != columns.end())
      return &value;
  }
  return nullptr;
}
} // namespace

template <int dim>
const Measured *measured_in(const StepReport<dim> &step, const std::string &column)
{
  if (column == "normal_resultant" || column == "friction_resultant")
  {
    if (step.contact.size() != 1)
      return nullptr;
    for (const Resultant<dim> &row : step.forces)
      if (row.kind == ForceKind::contact && row.boundary == step.contact.front().boundary)
        return column == "normal_resultant" ? &row.normal : &row.friction;
    return nullptr;
  }
  if (const ProbeValue<dim> *const value = probe_of(step, column))
    for (unsigned int d = 0; d < dim; ++d)
      if (column == step.scene.probes[value->probe].name + "_u" + "xyz"[d])
        return &value->displacement[d];
  return nullptr;
}

template <int dim>
double relative_half_width(const StepReport<dim> &step)
{
  const std::string &column = step.scene.adaptivity.tolerance_column;
  if (column == equilibrated_estimate)
    return step.equilibrated.relative;
  if (const Measured *const one = measured_in(step, column))
    return one->half_width_about(one->value) / std::abs(one->value);
  const ProbeValue<dim> *const probe = probe_of(step, column);
  if (!probe)
    return no_number;
  double square = 0, widest = 0;
  for (const Measured &component : probe->displacement)
  {
    const double half_width = component.half_width_about(component.value);
    square += component.value * component.value;
    if (std::isnan(half_width))
      return no_number;
    widest = std::max(widest, half_width);
  }
  return widest / std::sqrt(square);
}

template <int dim>
std::string no_half_width(const StepReport<dim> &step)
{
  const ProbeValue<dim> *const probe = probe_of(step, step.scene.adaptivity.tolerance_column);
  if (probe && !step.scene.probes[probe->probe].is_mean())
    return "a value at a point has none; give the probe a Size";
  return step.no_intervals.empty() ? "none is known of it" : step.no_intervals;
}

template const Measured *measured_in(const StepReport<2> &, const std::string &);
template const Measured *measured_in(const StepReport<3> &, const std::string &);
template double relative_half_width(const StepReport<2> &);
template double relative_half_width(const StepReport<3> &);
template std::string no_half_width(const StepReport<2> &);
template std::string no_half_width(const StepReport<3> &);
} // namespace hpvi
