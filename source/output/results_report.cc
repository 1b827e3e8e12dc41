// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/contact_report.h>
#include <hpvi/output/pretension_report.h>
#include <hpvi/output/record.h>
#include <hpvi/output/results_report.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

std::string interval_in_words(const Interval &interval)
{
  const auto [centre, half_width] = interval;
  if (!(half_width > 0) || !std::isfinite(half_width) || !std::isfinite(centre))
    return text(centre) + " +- " + text(half_width);
  const double unit = std::pow(10., std::floor(std::log10(half_width)) - 1),
               rounded = unit * std::round(centre / unit) + 0., // no -0
      widened = std::ceil((half_width + std::abs(centre - rounded)) / unit) * unit;
  const int digits = rounded == 0
                         ? 1
                         : std::clamp(int(std::floor(std::log10(std::abs(rounded)) + 1e-9)) -
                                          int(std::round(std::log10(unit))) + 1,
                                      1, 16);
  return text(rounded, digits) + " +- " + text(widened, 3);
}

namespace
{
/** A number of few digits that is no less: what is guaranteed stays so. */
std::string at_most(const double value)
{
  if (!(value > 0) || !std::isfinite(value))
    return text(value, 2);
  const double unit = std::pow(10., std::floor(std::log10(value)) - 1);
  return text(unit * std::ceil(value / unit), 2);
}

/**
 * What is known of the error, as in "at most 0.31 % of the solution, guaranteed". @p kind: text(BoundKind); @p size: of the error with its
 * unit, as at_most() has it; @p coupling, @p how it is known and @p zones as in ErrorBound. Never that a bound is one without the coupling that it needs.
 */
std::string error_in_words(const std::string &kind, const std::string &size, const double coupling,
                           const std::string &how, const std::string &zones)
{
  const std::string known =
      "if the coupling is at most " + at_most(coupling) + " (" + how + "; it must be below 2)";
  if (kind == "coupling")
    return "at most " + size + " for every solution of Coulomb's law, bounded " + known;
  if (kind == "zones")
    return "at most " + size + " if " + zones + ", and " + known;
  if (kind == "history")
    return "at most " + size + " for the slip that load steps before have computed, bounded" +
           (std::isfinite(coupling) ? " " + known : "");
  if (kind == "estimate")
    return "about " + size + ", estimated";
  return "at most " + size + ", guaranteed";
}

/** What an interval rests on, as in "guaranteed" or "bounded, coupling at most 1.4". @p kind and @p coupling likewise. */
std::string terms_in_words(const std::string &kind, const double coupling)
{
  if (kind == "coupling")
    return "bounded, coupling at most " + at_most(coupling);
  if (kind == "zones")
    return "if zones are as said, coupling at most " + at_most(coupling);
  if (kind == "history")
    return "bounded for the computed history" +
           (std::isfinite(coupling) ? ", coupling at most " + at_most(coupling) : "");
  return "guaranteed";
}
/** With what it rests on, of a step that has a bound. */
template <int dim>
std::string interval_of(const StepReport<dim> &step, const Interval &interval)
{
  return interval_in_words(interval) + " (" +
         terms_in_words(text(step.bound->kind), step.equilibrated.coupling) + ")";
}

/** Those of forces that have any. */
template <int dim>
std::string intervals_in_words(const StepReport<dim> &step)
{
  std::string words;
  const auto add = [&](const std::string &what, const Measured &number)
  {
    if (number.interval)
      words += what + " " + interval_of(step, *number.interval) + "\n";
  };
  for (const Resultant<dim> &row : step.forces)
  {
    for (unsigned int d = 0; d < dim; ++d)
      add(std::string("force ") + "xyz"[d] + " on " + row.name, row.force[d]);
    for (unsigned int d = 0; d < row.n_moments; ++d)
      add("moment " + (dim == 2 ? "" : std::string(1, "xyz"[d]) + " ") + "on " + row.name,
          row.moment[d]);
    add((row.kind == ForceKind::pretension ? "tension of " : "normal force on ") + row.name,
        row.normal);
    add("friction on " + row.name, row.friction);
  }
  return words;
}

/** As in "probe tip: ux 0.0123, uy -4e-05 mm; s1 3, s2 0, szz 0, von Mises 3 MPa". */
template <int dim>
std::string probe_in_words(const ProbeValue<dim> &value, const StepReport<dim> &step)
{
  const Scene<dim> &scene = step.scene;
  const Probe<dim> &probe = scene.probes[value.probe];
  std::string words = "probe " + probe.name + ":";
  if (!std::isfinite(value.displacement[0].value))
    return words + " not in the body\n";
  for (unsigned int d = 0; d < dim; ++d)
  {
    const Measured &number = value.displacement[d];
    words +=
        std::string(d > 0 ? ", u" : " u") + "xyz"[d] + " " +
        (number.interval ? interval_of(step, *number.interval) : text(number.value, shown_digits));
  }
  const auto unit = [](const std::string &label)
  { return unit_name(label).empty() ? "" : " " + unit_name(label); };
  const std::array<double, 3> principal = principal_stresses<dim>(value.stress);
  return words + unit(scene.length_unit) + "; s1 " + text(principal[0], shown_digits) + ", s2 " +
         text(principal[1], shown_digits) + (dim == 2 ? ", szz " : ", s3 ") +
         text(principal[2], shown_digits) + ", von Mises " +
         text(von_mises(value.stress), shown_digits) + unit(scene.stress_unit) + "\n";
}

template <int dim>
std::string extremes_in_words(const StepReport<dim> &step)
{
  const Scene<dim> &scene = step.scene;
  const PlacedValue<dim> &displacement = step.largest_displacement;
  std::string words = "largest displacement " +
                      with_unit(displacement.value, scene.length_unit, shown_digits) +
                      (displacement.value > 0 ? " at " + to_string(displacement.where) : "") + "\n";
  if (std::none_of(step.unbounded.begin(), step.unbounded.end(),
                   [](const StressSingularity<dim> &stress)
                   { return stress.peak.boundary == numbers::invalid_boundary_id; }))
  {
    const StressSample<dim> &stress = largest_von_mises(step);
    words += "largest von Mises' stress " +
             with_unit(stress.value, scene.stress_unit, shown_digits) +
             (stress.value > 0 ? " at " + to_string(stress.where) : "") + "\n";
  }
  return words;
}

/** What is known of the error under Coulomb's law. */
template <int dim>
std::string bound_of_coulomb(const StepReport<dim> &step)
{
  const auto &[norm, relative, coupling, kind, zones, known] = step.equilibrated;
  if (kind.empty() || kind == text(BoundKind::energy))
    return {};
  const std::string size =
      step.bound ? at_most(100 * step.relative_bound) : text(100 * relative, 2);
  return "error in the energy norm: " +
         error_in_words(kind, size + " % of the solution", coupling, known, zones) + "\n";
}
} // namespace

template <int dim>
std::string results_in_words(const StepReport<dim> &step)
{
  std::string words = "\n" + bound_of_coulomb(step) + intervals_in_words(step);
  if (!step.no_intervals.empty() && step.bound) // else it is why the error has no bound
    words += "without an interval: " + step.no_intervals + "\n";
  words += pretensions_in_words(step);
  for (const ProbeValue<dim> &value : step.probes)
    words += probe_in_words(value, step);
  return words + extremes_in_words(step);
}

template std::string results_in_words(const StepReport<2> &);
template std::string results_in_words(const StepReport<3> &);
} // namespace hpvi
