// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/driver/column_width.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/probe_table.h>
#include <hpvi/output/result_directory.h>

#include <array>
#include <cmath>

namespace hpvi
{
namespace
{
/** About the value that stands beside it. */
Value bound_of(const Measured *const number)
{
  return number ? Value(number->half_width_about(number->value)) : Value();
}

/** By the ends of their names, as columns_of() has them. */
template <int dim>
std::array<std::pair<const char *, double>, 4> invariants(const FullStress &stress)
{
  const std::array<double, 3> principal = principal_stresses<dim>(stress);
  return {{{"s1", principal[0]},
           {"s2", principal[1]},
           {dim == 2 ? "szz" : "s3", principal[2]},
           {"mises", von_mises(stress)}}};
}

template <int dim>
std::string in_words(const Probe<dim> &probe, const std::string &length_unit)
{
  switch (probe.kind)
  {
  case ProbeKind::point:
    return "at " + to_string(probe.at);
  case ProbeKind::disc:
    return "mean over the disc of radius " + with_unit(probe.size, length_unit) + " about " +
           to_string(probe.at);
  case ProbeKind::boundary:
    return "mean along " + probe.side;
  case ProbeKind::line:
    return text(probe.n_points) + " points from " + to_string(probe.from) + " to " +
           to_string(probe.to);
  }
  return {};
}
} // namespace

template <int dim>
Record probe_record(const StepReport<dim> &step)
{
  Record record;
  for (const char *const column : {"normal_resultant", "friction_resultant"})
    record.emplace_back(column + std::string("_bound"), bound_of(measured_in(step, column)));
  for (const ProbeValue<dim> &value : step.probes)
  {
    const std::string &name = step.scene.probes[value.probe].name;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const std::string column = name + "_u" + "xyz"[d];
      record.emplace_back(column, value.displacement[d].value);
      record.emplace_back(column + "_bound", bound_of(&value.displacement[d]));
    }
    for (const auto &[end, number] : invariants<dim>(value.stress))
      record.emplace_back(name + "_" + end, number);
  }
  return record;
}

template <int dim>
std::string probe_file(const Scene<dim> &scene, const ProbeLine<dim> &line, const unsigned int step)
{
  return numbered("probe-" + scene.probes[line.probe].name, step, ".csv");
}

template <int dim>
std::vector<Record> probe_rows(const ProbeLine<dim> &line)
{
  std::vector<Record> rows;
  for (const LinePoint<dim> &point : line.points)
  {
    Record row;
    for (unsigned int d = 0; d < dim; ++d)
      row.emplace_back(std::string(1, "xyz"[d]), point.x[d]);
    for (unsigned int d = 0; d < dim; ++d)
      row.emplace_back(std::string("u") + "xyz"[d], point.displacement[d]);
    for (unsigned int d = 0; d < dim; ++d)
      row.emplace_back(std::string("s_") + "xyz"[d] + "xyz"[d], point.stress[d][d]);
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int e = d + 1; e < dim; ++e)
        row.emplace_back(std::string("s_") + "xyz"[d] + "xyz"[e], point.stress[d][e]);
    for (const auto &[end, number] : invariants<dim>(point.stress))
      row.emplace_back(end, number);
    rows.push_back(row);
  }
  return rows;
}

template <int dim>
std::string probes_in_words(const Scene<dim> &scene)
{
  std::string lines;
  for (const Probe<dim> &probe : scene.probes)
    lines += "probe " + probe.name + ": " + in_words(probe, scene.length_unit) + "\n";
  return lines;
}

template Record probe_record(const StepReport<2> &);
template Record probe_record(const StepReport<3> &);
template std::string probe_file(const Scene<2> &, const ProbeLine<2> &, unsigned int);
template std::string probe_file(const Scene<3> &, const ProbeLine<3> &, unsigned int);
template std::vector<Record> probe_rows(const ProbeLine<2> &);
template std::vector<Record> probe_rows(const ProbeLine<3> &);
template std::string probes_in_words(const Scene<2> &);
template std::string probes_in_words(const Scene<3> &);
} // namespace hpvi
