// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/version.h>
#include <hpvi/output/contact_report.h>
#include <hpvi/output/summary.h>
#include <hpvi/output/tables.h>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
std::string json_force(const BoundaryForce<dim> &force)
{
  return json_string(force.boundary) + ": {\"force\": " + json_point<dim>(force.force) +
         ", \"moment\": " + text(force.moment) + "}";
}

/** Two members of summary.json: forces by boundary, and how well they balance. */
template <int dim>
std::string json_equilibrium(const Equilibrium<dim> &equilibrium)
{
  std::string forces = "\n    " + json_force(equilibrium.loads);
  for (const BoundaryForce<dim> &reaction : equilibrium.reactions)
    forces += ",\n    " + json_force(reaction);
  return "  \"forces\": {" + forces +
         "\n  },\n  \"balance\": {\n    \"force\": " + text(equilibrium.force_imbalance) +
         ",\n    \"moment\": " + text(equilibrium.moment_imbalance) +
         ",\n    \"moments_about\": " + json_point<dim>(equilibrium.centre) + "\n  },\n";
}

/** A member of summary.json: what became of a history of loads; nothing without one. */
std::string json_loading(const LoadStep &load, const unsigned int n_load_steps)
{
  if (n_load_steps == 0)
    return {};
  return "  \"loading\": {\n    \"load_steps\": " + text(n_load_steps) +
         ",\n    \"finished\": " + text(load.number) + ",\n    \"t\": " + text(load.t) +
         ",\n    \"dissipated_energy\": " + text(load.dissipated) +
         ",\n    \"work\": " + text(load.work) + ",\n    \"stored_energy\": " + text(load.stored) +
         "\n  },\n";
}

/** The items of an array, each on a line of its own. */
template <class Lines>
std::string json_lines(const Lines &lines)
{
  std::string list;
  for (const std::string &line : lines)
    list += (list.empty() ? "\n    " : ",\n    ") + json_string(line);
  return list.empty() ? "" : list + "\n  ";
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
  bound = step.bound;
  no_bound = step.no_bound;
  relative_bound = step.relative_bound;
  energy = step.energies.energy;
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
         ",\n    \"energy\": [" + text(energy - bound->energy_below) + ", " +
         text(energy + bound->energy_above) + "]\n  },\n";
}

template <int dim>
std::string Summary<dim>::json(const Scene<dim> &scene, const std::set<std::string> &files) const
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
         ",\n    \"stress\": " + json_string(scene.stress_unit) +
         "\n  },\n  \"steps\": " + std::to_string(steps) +
         ",\n  \"final\": " + (steps == 0 ? "null" : json_object(last_row)) + ",\n" +
         json_loading(load, scene.loading.steps) +
         (stopped_by.empty() ? ""
                             : json_bound() + json_equilibrium(equilibrium) + "  \"contact\": " +
                                   contact_json(scene, contact, equilibrium) + ",\n") +
         "  \"seconds\": " + json_object(stage_record(times)) + ",\n  \"warnings\": [" +
         json_lines(warnings) + "],\n  \"files\": [" + json_lines(files) + "]\n}\n";
}

template struct Summary<2>;
} // namespace hpvi
