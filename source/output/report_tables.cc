// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/html.h>
#include <hpvi/output/report_tables.h>
#include <hpvi/output/results_report.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace hpvi
{
namespace
{
/** What is a number is rounded. */
std::string shown(const Value &field, const int n_digits = shown_digits)
{
  const std::optional<double> value = number(field);
  return value ? text(*value, n_digits) : text(field);
}

/** Without columns that are empty in each row. */
HtmlTable without_empty_columns(const HtmlTable &table)
{
  HtmlTable result;
  result.rows.resize(table.rows.size());
  for (std::size_t c = 0; c < table.head.size(); ++c)
    if (std::any_of(table.rows.begin(), table.rows.end(),
                    [&](const auto &row) { return !row[c].empty() && row[c] != "..."; }))
    {
      result.head.push_back(table.head[c]);
      for (std::size_t r = 0; r < table.rows.size(); ++r)
        result.rows[r].push_back(table.rows[r][c]);
    }
  return result;
}

/** Forces that are round-off beside the largest are none, for it is another on each machine. */
double force_round_off(const std::vector<Record> &forces)
{
  double largest = 0;
  for (const Record &row : forces)
    for (std::size_t k = 5; k < row.size(); k += 2)
      largest = std::max(largest, std::abs(number(row[k].second).value_or(0)));
  return shown_as_zero * largest;
}

HtmlTable forces_table(const std::vector<Record> &forces)
{
  const double least = force_round_off(forces);
  HtmlTable table{{"boundary", "kind"}, {}};
  for (const Record &row : forces)
  {
    std::vector<std::string> fields{words_of(row, "name"), words_of(row, "kind")};
    for (std::size_t k = 5; k + 1 < row.size(); k += 2)
    {
      if (table.rows.empty())
        table.head.push_back(row[k].first);
      const std::optional<double> centre = number(row[k].second),
                                  half_width = number(row[k + 1].second);
      fields.push_back(centre && half_width ? interval_in_words({*centre, *half_width})
                       : centre && std::abs(*centre) < least ? "0"
                                                             : shown(row[k].second));
    }
    table.rows.push_back(fields);
  }
  return without_empty_columns(table);
}

/** As in " [N]"; empty where there is no name. */
std::string bracketed(const std::string &unit)
{
  return unit.empty() ? "" : " [" + unit + "]";
}

std::string balance_words(const JsonTree &summary)
{
  const JsonTree *const balance = member(summary, "balance");
  if (!balance)
    return {};
  std::string words = "Balance: forces to " + shown(words_of(*balance, "force"), 2) +
                      ", moments to " + shown(words_of(*balance, "moment"), 2) +
                      " of their absolute sums";
  if (const JsonTree *const bodies = member(*balance, "bodies"))
    for (const auto &[name, body] : *bodies)
      words += "; of " + name + " " + shown(words_of(body, "force"), 2) + " and " +
               shown(words_of(body, "moment"), 2);
  return element("p", words + ".") + "\n";
}

std::string loading_words(const JsonTree &summary, const std::string &energy)
{
  const JsonTree *const loading = member(summary, "loading");
  if (!loading)
    return {};
  const auto of = [&](const std::string &name) { return shown(words_of(*loading, name)); };
  std::string dissipated = of("dissipated_energy");
  if (const std::string other = of("dissipated_energy_trapezoidal"); !other.empty())
    dissipated += " (" + other + " by the trapezoidal rule)";
  return element("p", "Load history: " + of("finished") + " of " + of("load_steps") +
                          " load steps, to t = " + of("t") + "; energies" + bracketed(energy) +
                          ": work " + of("work") + ", stored " + of("stored_energy") +
                          ", dissipated by friction " + dissipated + ", released " +
                          of("released_energy") + ", unbalanced " + of("unbalanced_energy") + ".") +
         "\n";
}

/** As in "Largest at the ends of load steps: pressure 3.2 MPa at (1, 0) of bottom in load step 4, ...". */
template <int dim>
std::string largest_words(const Scene<dim> &scene, const JsonTree &summary)
{
  const JsonTree *const largest = member(summary, "history_largest");
  if (!largest)
    return {};
  std::string words;
  for (const auto &[name, what, unit] : {std::tuple{"pressure", "pressure", scene.stress_unit},
                                         {"von_mises", "von Mises' stress", scene.stress_unit},
                                         {"opening", "opening", scene.length_unit}})
  {
    const JsonTree *const one = member(*largest, name);
    if (!one)
      continue;
    std::string place;
    for (const auto &coordinate : one->get_child("at"))
      place += (place.empty() ? "" : ", ") + shown(coordinate.second.data());
    const std::string boundary = words_of(*one, "boundary");
    words += (words.empty() ? "" : ", ") + std::string(what) + " " +
             shown(words_of(*one, "value")) + bracketed(unit) + " at (" + place + ")" +
             (boundary.empty() ? "" : " of " + boundary) + " in load step " +
             words_of(*one, "load_step");
  }
  return words.empty() ? ""
                       : element("p", "Largest at the ends of load steps: " + words + ".") + "\n";
}
} // namespace

template <int dim>
std::string forces_words(const Scene<dim> &scene, const RunFiles &files)
{
  const std::string moment = moment_unit(scene.stress_unit, scene.length_unit);
  std::string note = "Forces" + bracketed(force_unit(scene.stress_unit, scene.length_unit)) +
                     " and moments" + bracketed(moment) + " on the body";
  if (scene.is_axisymmetric())
    note += ", of the full turn";
  else if (dim == 2)
    note += ", for a thickness of " + with_unit(scene.thickness, scene.length_unit, shown_digits);
  if (const std::string why = words_of(files.summary, "no_intervals"); !why.empty())
    note += "; without an interval: " + why;
  return (files.forces.empty() ? "" : element("p", note + ".") + "\n") +
         html(forces_table(files.forces)) + balance_words(files.summary) +
         loading_words(files.summary, moment) + largest_words(scene, files.summary);
}

namespace
{
struct Column
{
  const char *name, *head;
  int digits;
};

constexpr Column columns[] = {{"step", "step", 9},
                              {"load_step", "load step", 9},
                              {"t", "t", 4},
                              {"elements", "elements", 9},
                              {"dofs_free", "free unknowns", 9},
                              {"multipliers", "multipliers", 9},
                              {"p_min", "p from", 9},
                              {"p_max", "to", 9},
                              {"estimate_relative", "indicator", 3},
                              {"error_bound_relative", "bound", 3},
                              {"error_relative", "true error", 3},
                              {"energy", "energy", 7},
                              {"slack", "slack", 2},
                              {"qp_multiplications", "products", 9},
                              {"newton_steps", "Newton steps", 9},
                              {"newton_cg", "cg steps", 9}};
} // namespace

std::string steps_table(const RunFiles &files)
{
  constexpr std::size_t first = 2, last = 18;
  HtmlTable table;
  for (const Column &column : columns)
    table.head.emplace_back(column.head);
  const std::size_t n = files.steps.size();
  for (std::size_t k = 0; k < n; ++k)
    if (n <= first + last + 1 || k < first || k >= n - last)
    {
      table.rows.emplace_back();
      for (const Column &column : columns)
        table.rows.back().push_back(shown(words_of(files.steps[k], column.name), column.digits));
    }
    else if (k == first)
      table.rows.emplace_back(table.head.size(), "...");
  return html(without_empty_columns(table)) +
         (n > first + last + 1 ? missing("convergence.csv has all " + std::to_string(n) + " steps")
                               : "");
}

std::string warnings_list(const JsonTree &summary)
{
  std::string list;
  if (const JsonTree *const warnings = member(summary, "warnings"))
    for (const auto &[key, warning] : *warnings)
      list += element("li", warning.data()) + "\n";
  return list.empty() ? element("p", "None.") + "\n" : "<ul>\n" + list + "</ul>\n";
}

/** Without that of the report itself, which is not over when a run writes it. */
std::string times_line(const JsonTree &summary)
{
  std::string words;
  double total = 0;
  if (const JsonTree *const stages = member(summary, "seconds"))
    for (const auto &[stage, seconds] : *stages)
    {
      if (stage == "report")
        continue;
      const double value = number(seconds.data()).value_or(0);
      total += value;
      words += ", " + stage + " " + text(value, 3);
    }
  words = "Seconds: " + text(total, 3) + " in all" + words;
  if (const JsonTree *const last = member(summary, "final"))
    if (const std::optional<double> memory = number_of(*last, "peak_memory"))
      words += "; memory " + bytes_text(*memory);
  return element("p", words + ".", "times") + "\n";
}

template std::string forces_words(const Scene<2> &, const RunFiles &);
template std::string forces_words(const Scene<3> &, const RunFiles &);
} // namespace hpvi
