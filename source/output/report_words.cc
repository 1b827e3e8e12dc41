// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/memory.h>
#include <hpvi/bound/error_bound.h>
#include <hpvi/output/bound_words.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/html.h>
#include <hpvi/output/report_words.h>
#include <hpvi/output/results_report.h>
#include <hpvi/output/stop_reason.h>
#include <hpvi/output/summary.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hpvi
{
namespace
{
std::string shown(const std::optional<double> &value, const int n_digits = shown_digits)
{
  return value ? text(*value, n_digits) : "";
}

/** With a unit behind. */
std::string shown(const JsonTree &tree, const std::string &name, const std::string &unit)
{
  const std::optional<double> value = number_of(tree, name);
  return value ? with_unit(*value, unit, shown_digits) : "?";
}

/** As in "(1, 0)"; empty where it is null. */
std::string place(const JsonTree &tree, const std::string &name)
{
  const JsonTree *const point = member(tree, name);
  std::string list;
  if (point)
    for (const auto &[key, value] : *point)
      list += (list.empty() ? "" : ", ") + shown(number(value.data()));
  return point ? "(" + list + ")" : "";
}

std::string at(const JsonTree &tree, const std::string &name)
{
  const std::string where = place(tree, name);
  return where.empty() ? "" : " at " + where;
}

std::string item(const std::string &words, const std::string &bold = "")
{
  return "<li>" + (bold.empty() ? "" : element("b", bold) + " ") + xml_text(words) + "</li>\n";
}
} // namespace

std::string ending_words(const JsonTree &summary, const Adaptivity &adaptivity)
{
  const std::string status = words_of(summary, "status"), message = words_of(summary, "message"),
                    steps = words_of(summary, "steps");
  const std::string left =
      steps == "0" ? " No step was finished: there is no result."
                   : " What follows is what step " + steps +
                         ", the last one that was finished, left: no result of this scene.";
  const JsonTree *const bound = member(summary, "error_bound");
  if (status == text(RunStatus::done))
    return element("p",
                   "Done: " +
                       stop_reason(stop_reason_from(words_of(summary, "stopped_by")), adaptivity,
                                   bound,
                                   bound && words_of(*bound, "kind") != text(BoundKind::energy)) +
                       ".",
                   "ending") +
           "\n";
  return element("p",
                 (status == text(RunStatus::failed) ? "This run failed: " + message + "."
                  : status == text(RunStatus::interrupted)
                      ? "This run was interrupted: " + message + "; hpvi --resume goes on with it."
                      : "This run did not come to its end: it was killed, or "
                        "the machine stopped; hpvi --resume goes on with it.") +
                     left,
                 "failed") +
         "\n";
}

// ---------------------------------------------------------------- the answer

namespace
{
/** As in " N"; empty where it has no name. */
std::string behind(const std::string &unit)
{
  return unit_name(unit).empty() ? "" : " " + unit_name(unit);
}

/** @p summary: it has the coupling of the last step. */
std::string bound_words(const JsonTree &bound, const JsonTree &summary, const std::string &energy)
{
  const std::optional<double> relative = number_of(bound, "relative");
  const std::string kind = words_of(bound, "kind"), zones = words_of(summary, "zones_assumed");
  const double coupling =
      number_of(summary, "coupling").value_or(std::numeric_limits<double>::quiet_NaN());
  std::string words =
      (relative ? "The energy error is " : "The error in the energy norm is ") +
      error_in_words(kind,
                     relative ? at_most(100 * *relative) + " % of the solution"
                              : at_most(number_of(bound, "energy_norm").value_or(0)),
                     coupling, zones);
  if (const std::string interval = place(bound, "energy"); !interval.empty())
    words += "; the least energy lies in [" + interval.substr(1, interval.size() - 2) + "]" +
             behind(energy);
  return words + ".";
}

std::string error_words(const JsonTree &summary, const std::string &energy)
{
  if (const JsonTree *const bound = member(summary, "error_bound"))
    return item(bound_words(*bound, summary, energy), "Error.");
  const JsonTree *const last = member(summary, "final");
  const std::optional<double> indicator =
      last ? number_of(*last, "estimate_relative") : std::nullopt;
  std::string words;
  if (indicator)
    words = "The error indicator says about " + text(100 * *indicator, 2) +
            " % of the solution in the energy norm: an estimate, no bound.";
  if (const JsonTree *const estimate = member(summary, "error_estimate_equilibrated"))
    if (const std::optional<double> part = number_of(*estimate, "relative"))
      words = "The energy error is " +
              error_in_words(text(BoundKind::estimate), text(100 * *part, 2) + " % of the solution",
                             0., "") +
              " by a stress in equilibrium: no bound.";
  if (const std::string why = words_of(summary, "no_error_bound"); !why.empty())
    words += " No bound is guaranteed: " + why + ".";
  if (const JsonTree *const earlier = member(summary, "last_error_bound"))
    words += " In step " + words_of(*earlier, "step") +
             " there was one: " + bound_words(*earlier, summary, energy);
  return words.empty() ? "" : item(words, "Error.");
}

std::string true_error_words(const JsonTree &summary)
{
  const JsonTree *const last = member(summary, "final");
  const std::optional<double> error = last ? number_of(*last, "error_relative") : std::nullopt;
  return error ? item("The true error, beside the solution that is known, is " +
                      text(100 * *error, 3) + " % in the energy norm.")
               : "";
}

/** With its interval where there is one. */
std::string measured(const std::string &value, const std::string &bound, const std::string &unit)
{
  const std::optional<double> centre = number(value), half_width = number(bound);
  if (!centre)
    return "";
  return half_width ? interval_in_words({*centre, *half_width}) + behind(unit) + " (guaranteed)"
                    : with_unit(*centre, unit, shown_digits);
}

/** A sentence for each place where a stress has no bound. */
std::string unbounded_words(const std::string &name, const JsonTree &tree,
                            const std::string &member_name, const std::string &stress,
                            const std::string &length, const std::string &force = "1")
{
  const JsonTree *const list = member(tree, member_name);
  std::string words;
  if (list)
    for (const auto &[key, peak] : *list)
      words += "; " + name + " is unbounded" + at(peak, "at") + " (" +
               shown(peak, "value", stress) + " there, more in smaller cells" +
               (member(peak, "force") ? ", of which the last " + shown(peak, "within", length) +
                                            " carry " + shown(peak, "force", force)
                                      : "") +
               "), beyond " + shown(peak, "beyond", length) + " from there it is up to " +
               shown(peak, "largest", stress) + at(peak, "largest_at");
  return words;
}

std::string zones_words(const JsonTree &contact, const std::string &length)
{
  constexpr unsigned int most = 8;
  const JsonTree *const zones = member(contact, "zones");
  std::string words;
  unsigned int n = 0;
  if (zones)
    for (const auto &[key, zone] : *zones)
      if (++n <= most)
        words += "; " + words_of(zone, "state") + " from " + place(zone, "from") + " to " +
                 place(zone, "to") + ", length " + shown(zone, "length", length);
  if (n > most)
    words += "; " + text(n - most) + " zones more";
  if (!zones)
    words += "; open " + shown(number_of(contact, "open_area")) + ", slip " +
             shown(number_of(contact, "slipping_area")) + " of the area " +
             shown(number_of(contact, "area")) +
             (unit_name(length).empty() ? "" : " " + unit_name(length) + "^2");
  return words;
}

/** A number, or in space a vector. */
std::string value_words(const JsonTree &tree, const std::string &name, const std::string &unit)
{
  const JsonTree *const value = member(tree, name);
  return !value
             ? ""
             : (value->empty() ? shown(number(value->data())) : place(tree, name)) + behind(unit);
}

template <int dim>
std::string contact_words(const Scene<dim> &scene, const RunFiles &files, const std::string &name,
                          const JsonTree &contact)
{
  const std::string stress = scene.stress_unit, length = scene.length_unit,
                    force = force_unit(stress, length);
  std::string normal = value_words(contact, "normal_resultant", force),
              friction = value_words(contact, "friction_resultant", force);
  for (const Record &row : files.forces)
    if (words_of(row, "name") == name && words_of(row, "kind") == "contact")
    {
      if (!words_of(row, "normal_bound").empty())
        normal = measured(words_of(row, "normal"), words_of(row, "normal_bound"), force);
      if (!words_of(row, "friction_bound").empty())
        friction = measured(words_of(row, "friction"), words_of(row, "friction_bound"), force);
    }
  const std::string unbounded =
      unbounded_words("pressure", contact, "unbounded_pressure", stress, length, force);
  std::string words = "normal resultant " + normal + ", friction " + friction + ", force " +
                      value_words(contact, "force", force) +
                      (member(contact, "through") ? " through " + place(contact, "through") : "");
  if (number_of(contact, "largest_pressure").value_or(0) > 0 && unbounded.empty())
    words += "; pressure up to " + shown(contact, "largest_pressure", stress) +
             at(contact, "largest_pressure_at");
  words += unbounded + zones_words(contact, length);
  if (number_of(contact, "largest_penetration").value_or(0) > 0)
    words += "; penetration between points up to " + shown(contact, "largest_penetration", length) +
             at(contact, "largest_penetration_at");
  return item(words + ".", "Contact " + name + ":");
}

template <int dim>
std::string extremes_words(const Scene<dim> &scene, const JsonTree &summary)
{
  std::string words;
  if (const JsonTree *const u = member(summary, "largest_displacement"))
    words +=
        item(shown(*u, "value", scene.length_unit) + at(*u, "at") + ".", "Largest displacement:");
  if (const JsonTree *const stress = member(summary, "von_mises"))
  {
    const std::string unbounded =
        unbounded_words("it", *stress, "unbounded", scene.stress_unit, scene.length_unit);
    words +=
        item((unbounded.empty() ? shown(*stress, "largest", scene.stress_unit) + at(*stress, "at")
                                : unbounded.substr(2)) +
                 ".",
             "Largest von Mises stress:");
  }
  return words;
}

/** Columns of the last row that probes have. */
template <int dim>
std::string probes_words(const Scene<dim> &scene, const RunFiles &files)
{
  std::string words;
  if (files.steps.empty())
    return words;
  const Record &last = files.steps.back();
  for (const Probe<dim> &probe : scene.probes)
  {
    std::string list;
    for (const std::string &column : columns_of(probe))
    {
      const std::string value = words_of(last, column), end = column.substr(probe.name.size() + 1);
      if (!value.empty() && end.find("_bound") == std::string::npos)
        list += (list.empty() ? "" : ", ") + end + " " +
                measured(value, words_of(last, column + "_bound"),
                         end[0] == 'u' ? scene.length_unit : scene.stress_unit);
    }
    if (!list.empty())
      words += item(list + ".", "Probe " + probe.name + ":");
  }
  return words;
}

std::string plates_words(const JsonTree &summary, const std::string &length)
{
  std::string words;
  if (const JsonTree *const plates = member(summary, "plates"))
    for (const auto &[name, plate] : *plates)
      words +=
          item("moves by " + place(plate, "displacement") +
                   (unit_name(length).empty() ? "" : " " + unit_name(length)) + " and turns by " +
                   shown(number_of(plate, "rotation")) + " rad" + at(plate, "mean_point") + ".",
               "Plate " + name + ":");
  return words;
}
} // namespace

template <int dim>
std::string answer_words(const Scene<dim> &scene, const RunFiles &files)
{
  const JsonTree &summary = files.summary;
  std::string words = error_words(summary, moment_unit(scene.stress_unit, scene.length_unit)) +
                      true_error_words(summary);
  if (const JsonTree *const contacts = member(summary, "contact"))
    for (const auto &[name, contact] : *contacts)
      words += contact_words(scene, files, name, contact);
  words += extremes_words(scene, summary) + plates_words(summary, scene.length_unit) +
           probes_words(scene, files);
  return words.empty() ? missing("there is none: no step came to the end of the run")
                       : "<ul>\n" + words + "</ul>\n";
}

template std::string answer_words(const Scene<2> &, const RunFiles &);
template std::string answer_words(const Scene<3> &, const RunFiles &);
} // namespace hpvi
