// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/version.h>
#include <hpvi/driver/threads.h>
#include <hpvi/output/contact_report.h>
#include <hpvi/output/json_tree.h>
#include <hpvi/output/pretension_report.h>
#include <hpvi/output/summary.h>
#include <hpvi/output/tables.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/reader/scene_reader.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace hpvi
{
using namespace dealii;
namespace fs = std::filesystem;

namespace
{
/** What became of a history of loads. */
std::string loading_json(const LoadStep &load, const unsigned int n_load_steps)
{
  if (n_load_steps == 0)
    return "null";
  Record record{{"load_steps", n_load_steps},
                {"finished", load.number},
                {"t", load.t},
                {"dissipated_energy", load.dissipated},
                {"work", load.work},
                {"stored_energy", load.stored},
                {"released_energy", load.released},
                {"unbalanced_energy", load.unbalanced},
                {"dissipated_energy_trapezoidal", load.trapezoidal}};
  if (load.cycle > 0)
    record.emplace_back("cycle", load.cycle);
  return json_object(record);
}

/** The largest of a history, in space of @p dim dimensions; null: there is none. */
template <int dim>
std::string largest_json(const Scene<dim> &scene, const HistoryLargest &largest)
{
  if (largest.load_step == 0)
    return "null";
  Point<dim> where;
  for (unsigned int d = 0; d < dim; ++d)
    where[d] = largest.where[d];
  const bool is_contact = largest.boundary < scene.boundaries.size();
  return json_members(
      {{"value", json_value(largest.value)},
       {"at", json_point<dim>(where)},
       {"boundary", json_value(is_contact ? scene.boundaries[largest.boundary].name : "")},
       {"load_step", text(largest.load_step)},
       {"t", text(largest.t)}});
}

template <int dim>
std::string history_json(const Scene<dim> &scene, const HistorySoFar &history)
{
  return json_members({{"pressure", largest_json(scene, history.pressure)},
                       {"von_mises", largest_json(scene, history.von_mises)},
                       {"opening", largest_json(scene, history.opening)}},
                      4);
}

/** The same without the factor of Coulomb's law, where there is no bound either. */
std::string estimate_json(const Record &row)
{
  const std::optional<double> norm = number_of(row, "error_estimate_equilibrated"),
                              of_all = number_of(row, "energy_norm");
  if (!norm || !of_all)
    return "null";
  return json_object({{"energy_norm", *norm}, {"relative", *norm == 0. ? 0. : *norm / *of_all}});
}

/** The bound in the row of its step; relative to a displacement of zero it is null. */
std::string bound_json(const Record &row)
{
  if (!number_of(row, "error_bound"))
    return "null";
  const auto field = [&](const std::string &column) { return json_value(value_of(row, column)); };
  const bool is_of_energy = text(value_of(row, "bound_kind")) == text(BoundKind::energy);
  return json_members(
      {{"step", field("step")},
       {"guaranteed", is_of_energy ? "true" : "false"},
       {"kind", field("bound_kind")},
       {"energy_norm", field("error_bound")},
       {"relative", field("error_bound_relative")},
       {"imbalance", field("bound_imbalance")},
       {"energy", is_of_energy ? json_list({field("energy_low"), field("energy_high")}) : "null"}},
      4);
}

JsonTree summary_in(const std::filesystem::path &directory)
{
  return json_tree(content_of(directory / "summary.json")).value_or(JsonTree());
}
} // namespace

std::string text(const RunStatus status)
{
  constexpr const char *words[] = {"not begun", "running",     "done",
                                   "failed",    "interrupted", "refused"};
  return words[static_cast<unsigned int>(status)];
}

void Summary::take_up(const std::vector<Record> &rows, const Record &last_load)
{
  const std::array<double *, 9> stages{{&times.setup, &times.assemble, &times.factor, &times.qp,
                                        &times.recover, &times.estimate, &times.bound,
                                        &times.decide, &times.refine}};
  for (const Record &row : rows)
  {
    if (number_of(row, "error_bound"))
      last_error_bound = bound_json(row);
    for (std::size_t k = 0; k < stages.size(); ++k)
      *stages[k] += number_of(row, std::string("seconds_") + times.named()[k].first).value_or(0);
  }
  steps = rows.size();
  last_row = rows.back();
  const auto number = [&](const char *const column)
  { return number_of(last_load, column).value_or(0); };
  load_step = static_cast<unsigned int>(number("load_step"));
  load = {load_step,
          number("t"),
          number("work"),
          number("dissipated_energy"),
          number("stored_energy"),
          number("released_energy"),
          number("unbalanced_energy"),
          number("dissipated_energy_trapezoidal"),
          static_cast<unsigned int>(number("cycle"))};
}

template <int dim>
void Summary::add(const StepReport<dim> &step, const Record &row)
{
  ++steps;
  if (step.bound || step.load.number != load_step)
    last_error_bound = bound_json(row);
  if (contradiction.empty())
    contradiction = step.contradiction;
  if (!contradiction.empty())
    last_error_bound = "null";
  load_step = step.load.number;
  last_row = row;
  times += step.times;
  stopped_by = step.stopped_by;
  linear = step.primal ? linear_names[static_cast<unsigned int>(step.primal->newton.linear)] : "";
  warnings = texts(step.warnings);
  if constexpr (dim == 2)
    if (step.reduced)
      loads = step.solution().spaces->loads->sum().times(step.scene.thickness);
  ending.clear();
  if (stopped_by.empty())
    return;
  load = step.load;
  const PlacedValue<dim> &largest = step.largest_displacement;
  ending = contact_members(step);
  ending.insert(
      ending.end(),
      {{"error_bound", bound_json(row)},
       {"no_error_bound", json_value(step.bound ? "" : step.no_bound)},
       {"error_estimate_equilibrated", estimate_json(row)},
       {"coupling", json_value(Value(step.equilibrated.coupling))},
       {"zones_assumed", json_value(step.equilibrated.zones)},
       {"coupling_known", json_value(step.equilibrated.coupling_known)},
       {"largest_displacement",
        json_members({{"value", json_value(largest.value)},
                      {"at", largest.value > 0 ? json_point<dim>(largest.where) : "null"}},
                     4)},
       {"no_intervals", json_value(step.no_intervals)},
       {"pretensions", pretensions_json(step)}});
  if (load.number > 0)
    ending.emplace_back("history_largest", history_json(step.scene, step.history));
}

template <int dim>
std::string Summary::json(const Scene<dim> &scene, const std::vector<std::string> &files) const
{
  const std::string normal_contact =
      scene.has_unilateral_contact()
          ? normal_contact_names[static_cast<unsigned int>(scene.normal_contact())]
          : "";
  const bool began_elsewhere = !scene_file.empty();
  const auto of_ending = [&](const std::string &name)
  {
    for (const auto &member : ending)
      if (member.first == name)
        return member;
    return std::pair(name, std::string("null"));
  };
  Record seconds = stage_record(times);
  JsonMembers entries{
      {"status", json_string(text(status))},
      {"stopped_by", json_value(text(stopped_by))},
      {"message", json_value(message)},
      {"scene", json_string(began_elsewhere ? fs::path(scene_file).stem().string() : scene.name)},
      {"scene_file", json_value(began_elsewhere    ? scene_file
                                : scene.parameters ? scene.file
                                                   : "")},
      {"title", json_string(scene.title)},
      {"program", json_string("hpvi " + version())},
      {"build", json_string(build_type())},
      {"deal.II", json_string(DEAL_II_PACKAGE_VERSION)},
      {"units", json_members({{"length", json_string(scene.length_unit)},
                              {"stress", json_string(scene.stress_unit)}},
                             4)},
      {"normal_contact", json_value(normal_contact)},
      {"linear", json_value(linear)},
      {"processes", text(processes)},
      {"threads", text(n_threads(scene, processes))},
      {"loads", loads_json(loads)},
      {"steps", text(steps)},
      {"final", steps == 0 ? "null" : json_object(last_row)},
      {"loading", loading_json(load, scene.loading.steps)},
      of_ending("error_bound"),
      of_ending("no_error_bound"),
      {"last_error_bound", last_error_bound},
      of_ending("error_estimate_equilibrated"),
      of_ending("coupling"),
      of_ending("zones_assumed"),
      of_ending("coupling_known"),
      of_ending("forces"),
      of_ending("balance"),
      of_ending("contact"),
      of_ending("von_mises"),
      of_ending("largest_displacement"),
      of_ending("no_intervals"),
      {"seconds", json_object(seconds)},
      {"warnings", json_strings(warnings, 4)},
      {"input_files", json_strings(input_files, 4)},
      {"files", json_strings(files, 4)}};
  if (scene.has_plates())
    entries.push_back(of_ending("plates"));
  if (!scene.pretensions.empty())
    entries.push_back(of_ending("pretensions"));
  if (scene.has_load_history())
    entries.push_back(of_ending("history_largest"));
  if (!contradiction.empty())
    entries.emplace_back("contradiction", json_string(contradiction));
  return json_file(entries);
}

bool is_complete_run(const std::filesystem::path &directory)
{
  const JsonTree summary = summary_in(directory);
  return words_of(summary, "status") == text(RunStatus::done) &&
         words_of(summary, "program") == "hpvi " + version();
}

template <int dim>
std::vector<std::string> input_files_of(const Scene<dim> &scene)
{
  std::vector<std::string> result =
      entries_of(effective_parameters(scene), [](const std::string &, const std::string &entry)
                 { return entry == "File" || entry == "Reference solution"; });
  const auto is_empty = [](const std::string &entry)
  { return entry.find(" = content ") == std::string::npos; };
  result.erase(std::remove_if(result.begin(), result.end(), is_empty), result.end());
  return result;
}

std::vector<std::string> input_files_of(const std::filesystem::path &directory)
{
  const JsonTree summary = summary_in(directory);
  std::vector<std::string> result;
  if (const JsonTree *const files = member(summary, "input_files"))
    for (const auto &file : *files)
      result.push_back(file.second.data());
  return result;
}

template std::vector<std::string> input_files_of(const Scene<2> &);
template std::vector<std::string> input_files_of(const Scene<3> &);
template void Summary::add(const StepReport<2> &, const Record &);
template void Summary::add(const StepReport<3> &, const Record &);
template std::string Summary::json(const Scene<2> &, const std::vector<std::string> &) const;
template std::string Summary::json(const Scene<3> &, const std::vector<std::string> &) const;
} // namespace hpvi
