// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/version.h>
#include <hpvi/output/contact_report.h>
#include <hpvi/output/summary.h>
#include <hpvi/output/tables.h>
#include <hpvi/scene/scene_entries.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A member of summary.json: what became of a history of loads; nothing without one. */
std::string json_loading(const LoadStep &load, const unsigned int n_load_steps)
{
  if (n_load_steps == 0)
    return {};
  return "  \"loading\": {\n    \"load_steps\": " + text(n_load_steps) +
         ",\n    \"finished\": " + text(load.number) + ",\n    \"t\": " + text(load.t) +
         ",\n    \"dissipated_energy\": " + text(load.dissipated) +
         ",\n    \"work\": " + text(load.work) + ",\n    \"stored_energy\": " + text(load.stored) +
         ",\n    \"released_energy\": " + text(load.released) +
         ",\n    \"unbalanced_energy\": " + text(load.unbalanced) + "\n  },\n";
}
} // namespace

template <int dim>
void Summary<dim>::add(const StepReport<dim> &step, const Record &row)
{
  ++steps;
  last_row = row;
  times += step.times;
  stopped_by = step.stopped_by;
  warnings = step.warnings;
  equilibrium = step.equilibrium;
  contact = step.contact;
  peaks = step.peaks;
  unbounded = step.unbounded;
  bound = step.bound;
  no_bound = step.no_bound;
  relative_bound = step.relative_bound;
  energy = step.energies.energy;
  loads = step.solution.spaces->loads->sum();
  if (!step.stopped_by.empty())
    load = step.load;
}

/** The guaranteed bound, or null and the reason. */
template <int dim>
std::string Summary<dim>::json_bound() const
{
  if (!bound)
    return "  \"error_bound\": null,\n  \"no_error_bound\": " + json_string(no_bound) + ",\n";
  return "  \"error_bound\": {\n    \"guaranteed\": true,\n    \"energy_norm\": " +
         text(bound->total) + ",\n    \"relative\": " + text(relative_bound) +
         ",\n    \"imbalance\": " + text(bound->imbalance) + ",\n    \"energy\": [" +
         text(energy - bound->energy_below) + ", " + text(energy + bound->energy_above) +
         "]\n  },\n";
}

template <int dim>
std::string Summary<dim>::json(const Scene<dim> &scene, const std::set<std::string> &files) const
{
  return json_head(scene, status, stopped_by, message) + loads_json(loads) +
         "  \"steps\": " + std::to_string(steps) +
         ",\n  \"final\": " + (steps == 0 ? "null" : json_object(last_row)) + ",\n" +
         json_loading(load, scene.loading.steps) +
         (stopped_by.empty()
              ? ""
              : json_bound() + equilibrium_json(equilibrium) +
                    "  \"contact\": " + contact_json(scene, contact, equilibrium, unbounded) +
                    ",\n  \"von_mises\": " + von_mises_json(peaks, unbounded) + ",\n") +
         json_tail(times, warnings, files);
}

template <int dim>
std::string json_head(const Scene<dim> &scene, const std::string &status,
                      const std::string &stopped_by, const std::string &message)
{
  std::string json = "{\n  \"status\": " + json_string(status) + ",\n";
  if (!stopped_by.empty())
    json += "  \"stopped_by\": " + json_string(stopped_by) + ",\n";
  if (!message.empty())
    json += "  \"message\": " + json_string(message) + ",\n";
  return json + "  \"scene\": " + json_string(scene.name) +
         ",\n  \"title\": " + json_string(scene.title) +
         ",\n  \"program\": " + json_string("hpvi " + version()) +
         ",\n  \"build\": " + json_string(build_type()) +
         ",\n  \"deal.II\": " + json_string(DEAL_II_PACKAGE_VERSION) +
         ",\n  \"units\": {\n    \"length\": " + json_string(scene.length_unit) +
         ",\n    \"stress\": " + json_string(scene.stress_unit) + "\n  },\n  \"normal_contact\": " +
         (scene.has_unilateral_contact()
              ? json_string(normal_contact_names[static_cast<unsigned int>(scene.normal_contact())])
              : "null") +
         ",\n";
}

std::string json_tail(const StageTimes &times, const std::vector<std::string> &warnings,
                      const std::set<std::string> &files)
{
  return "  \"seconds\": " + json_object(stage_record(times)) +
         ",\n  \"warnings\": " + json_lines(warnings) + ",\n  \"files\": " + json_lines(files) +
         "\n}\n";
}

template std::string json_head(const Scene<2> &, const std::string &, const std::string &,
                               const std::string &);
template std::string json_head(const Scene<3> &, const std::string &, const std::string &,
                               const std::string &);
template struct Summary<2>;
} // namespace hpvi
