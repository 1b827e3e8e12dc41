// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/contact_report.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/output.h>
#include <hpvi/output/primal_output.h>
#include <hpvi/output/summary.h>
#include <hpvi/output/tables.h>
#include <hpvi/output/vtu.h>
#include <hpvi/scene/parameters.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>

namespace hpvi
{
using namespace dealii;

namespace
{
std::string numbered(const std::string &name, const unsigned int step, const std::string &suffix)
{
  return name + (step < 10 ? "-0" : "-") + std::to_string(step) + suffix;
}

std::string known(const double value)
{
  return std::isfinite(value) ? text(value) : "";
}

/** Nothing where no contact can be penetrated. */
template <int dim>
std::string json_penetration(const BoundaryCondition<dim> &boundary,
                             const Penetration<dim> &penetration)
{
  if (!boundary.is_unilateral())
    return "";
  return ",\n      \"largest_penetration\": " + text(penetration.depth) +
         ",\n      \"largest_penetration_at\": " +
         (penetration.depth > 0 ? json_point<dim>(penetration.x) : "null");
}

/** A member of summary.json: force, pressure and zones of each contact boundary. */
template <int dim>
std::string json_contact(const Scene<dim> &scene, const std::vector<MomentPoint<dim>> &points,
                         const std::vector<Penetration<dim>> &penetrations)
{
  std::string list;
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    if (!boundary.has_contact())
      continue;
    double normal = 0, area = 0, open = 0, slipping = 0, pressure = 0;
    Tensor<1, dim> friction;
    Point<dim> at;
    for (const MomentPoint<dim> &point : points)
    {
      if (point.boundary != boundary.id)
        continue;
      normal += point.area * point.normal_traction;
      friction -= point.area * point.bound * point.lambda;
      area += point.area;
      open += point.mode() == ContactMode::open ? point.area : 0.;
      slipping += point.mode() == ContactMode::slip ? point.area : 0.;
      if (-point.normal_traction > pressure)
      {
        pressure = -point.normal_traction;
        at = point.x;
      }
    }
    list += (list.empty() ? "\n    " : ",\n    ") + json_string(boundary.name) +
            ": {\n      \"normal_resultant\": " + text(normal) +
            ",\n      \"friction_resultant\": " + json_point<dim>(friction) +
            ",\n      \"largest_pressure\": " + text(pressure) +
            ",\n      \"largest_pressure_at\": " + (pressure > 0 ? json_point<dim>(at) : "null") +
            json_penetration(boundary, penetrations[boundary.id]) +
            ",\n      \"area\": " + text(area) + ",\n      \"open_area\": " + text(open) +
            ",\n      \"slipping_area\": " + text(slipping) + "\n    }";
  }
  return "  \"contact\": {" + list + (list.empty() ? "" : "\n  ") + "},\n";
}

/** int T_n and, by component, int T_t of the one contact boundary; empty where there are more. */
template <int dim>
Record resultants(const std::vector<MomentPoint<dim>> &points)
{
  double normal = 0;
  Tensor<1, dim> friction;
  bool one = !points.empty();
  for (const MomentPoint<dim> &point : points)
  {
    one = one && point.boundary == points.front().boundary;
    normal += point.area * point.normal_traction;
    friction -= point.area * point.bound * point.lambda;
  }
  Record record{{"normal_resultant", one ? text(normal) : ""}};
  for (unsigned int d = 0; d < dim; ++d)
    record.emplace_back(std::string("friction_resultant_") + "xyz"[d],
                        one ? text(friction[d]) : "");
  return record;
}

/** together(), where what goes wrong is that something cannot be written. */
void write_together(MPI_Comm communicator, const std::function<void()> &work)
{
  try
  {
    together(communicator, work);
  }
  catch (const InputError &)
  {
    throw;
  }
  catch (const std::runtime_error &error)
  {
    throw OutputFailure(error.what());
  }
}

/** The columns of the reduced path that have a meaning here, and what Newton's method did. */
template <int dim>
Record convergence_record(const PrimalReport<dim> &step)
{
  const std::string degree = std::to_string(step.space.tables.degree);
  const bool unilateral = step.space.scene.has_unilateral_contact();
  Record record{{"step", text(step.number)},
                {"elements", std::to_string(step.n_cells)},
                {"dofs", std::to_string(step.space.dof_handler.n_dofs())},
                {"dofs_free", std::to_string(step.space.n_free)},
                {"multipliers", std::to_string(step.space.n_multipliers())},
                {"p_min", degree},
                {"p_max", degree},
                {"estimate", text(step.total_estimate)},
                {"lagrangian", text(step.energies.lagrangian)},
                {"energy", text(step.energies.energy)},
                {"slack", text(step.energies.slack)},
                {"seconds", text(step.seconds, 6)},
                {"estimate_volume", text(step.estimate_volume)},
                {"estimate_jumps", text(step.estimate_jumps)},
                {"estimate_neumann", text(step.estimate_neumann)},
                {"estimate_contact", text(step.estimate_contact)},
                {"estimate_normal", unilateral ? text(step.estimate_normal) : ""},
                {"estimate_penetration", unilateral ? text(step.estimate_penetration) : ""},
                {"estimate_tension", unilateral ? text(step.estimate_tension) : ""},
                {"estimate_scaled", text(step.scaled_estimate)},
                {"estimate_relative", known(step.relative_estimate)},
                {"energy_norm", text(step.energies.norm)},
                {"newton_steps", text(step.newton.steps)},
                {"newton_cg", text(step.newton.cg_steps)},
                {"newton_setups", text(step.newton.setups)},
                {"newton_fell_back", text(static_cast<unsigned int>(step.newton.fell_back))},
                {"newton_line_searches", text(step.newton.line_searches)},
                {"newton_residual", text(step.newton.residual)},
                {"newton_error", text(step.newton.error)},
                {"augmented_steps", text(step.newton.augmented_steps)},
                {"slipping", text(step.newton.n_slipping)},
                {"pressing", unilateral ? text(step.newton.n_pressing) : ""},
                {"peak_memory", text(step.peak_memory)},
                {"processes", text(Utilities::MPI::n_mpi_processes(step.space.communicator()))}};
  for (const auto &field : resultants(step.contact))
    record.push_back(field);
  for (const auto &[stage, seconds] : stage_record(step.times))
    record.emplace_back("seconds_" + stage, seconds);
  return record;
}
} // namespace

template <int dim>
PrimalOutput<dim>::PrimalOutput(const Scene<dim> &scene, const std::string &path,
                                MPI_Comm communicator)
    : scene(scene), path(path), communicator(communicator),
      is_first(Utilities::MPI::this_mpi_process(communicator) == 0)
{
  write_together(
      communicator,
      [&]()
      {
        if (!is_first)
          return;
        directory = std::make_unique<ResultDirectory>(
            path, [this](const std::string &name) { return writes(name); },
            std::vector<std::string>{scene.parameters ? scene.parameters->file_name() : ""});
        write("summary.json", summary());
        directory->remove_earlier();
        if (scene.parameters)
          write("scene.prm", scene.effective_parameters());
        write("summary.json", summary());
        is_usable = true;
      });
}

template <int dim>
bool PrimalOutput<dim>::writes(const std::string &name) const
{
  const auto matches = [&name](const char *pattern)
  { return std::regex_match(name, std::regex(pattern)); };
  return matches("scene\\.prm|convergence\\.csv|degrees\\.csv|summary\\.json") ||
         (scene.output.contact && scene.has_contact() && matches("contact-[0-9]{2,}\\.csv")) ||
         (scene.output.vtu && matches("solution(-[0-9]{2,}\\.(pvtu|[0-9]+\\.vtu)|\\.pvd)"));
}

template <int dim>
void PrimalOutput<dim>::write(const std::string &name, const std::string &content)
{
  if (directory->add(name))
    directory->write("summary.json", summary()); // names the file before it is there
  const std::error_code error = directory->write(name, content);
  if (!error)
    return;
  const std::string reason = name + " cannot be written: " + error.message();
  if (!is_usable)
    directory->reject(reason);
  throw OutputFailure(directory->name() + ": " + reason + "; " + safe_steps());
}

template <int dim>
std::string PrimalOutput<dim>::safe_steps() const
{
  if (rows.empty())
    return "no step is finished";
  return rows.size() == 1 ? "step 1 is safe"
                          : "steps 1 to " + std::to_string(rows.size()) + " are safe";
}

/** Each process writes its piece, the first one announces them all. */
template <int dim>
void PrimalOutput<dim>::write_solution(const PrimalReport<dim> &step)
{
  const unsigned int n = Utilities::MPI::n_mpi_processes(communicator);
  std::vector<std::string> pieces;
  for (unsigned int rank = 0; rank < n; ++rank)
    pieces.push_back(numbered("solution", step.number, "." + std::to_string(rank) + ".vtu"));
  const PrimalVtu content = vtu(step, pieces);
  const std::string name = numbered("solution", step.number, ".pvtu");
  write_together(communicator,
                 [&]()
                 {
                   if (!is_first)
                     return;
                   for (const std::string &piece : pieces)
                     directory->add(piece);
                   write(name, content.index);
                   solutions.emplace_back(step.number, name);
                   write("solution.pvd", pvd(solutions));
                 });
  write_together(communicator,
                 [&]()
                 {
                   const std::string piece = pieces[Utilities::MPI::this_mpi_process(communicator)];
                   std::ofstream file(std::filesystem::path(path) / piece);
                   if (!(file << content.piece).flush())
                     throw OutputFailure("output directory '" + path + "': " + piece +
                                         " cannot be written; " + safe_steps());
                 });
}

template <int dim>
void PrimalOutput<dim>::write_tables(const PrimalReport<dim> &step)
{
  if (scene.output.contact && scene.has_contact())
    write(numbered("contact", step.number, ".csv"), contact_table(scene, step.contact));
  rows.push_back(convergence_record(step));
  degrees.push_back({{"step", text(step.number)}, {"elements", std::to_string(step.n_cells)}});
  for (unsigned int p = 1; p <= step.space.tables.degree; ++p)
    degrees.back().emplace_back("p" + text(p),
                                p < step.space.tables.degree ? "0" : std::to_string(step.n_cells));
  write("convergence.csv", csv(rows));
  write("degrees.csv", csv(degrees));
  times += step.times;
  stopped_by = step.stopped_by;
  warnings = step.warnings;
  if (!stopped_by.empty())
    forces = "  \"error_bound\": null,\n  \"no_error_bound\": \"the primal path has no guaranteed "
             "bound of "
             "the error\",\n" +
             equilibrium_json(step.equilibrium) +
             json_contact(scene, step.contact, step.penetrations);
  write("summary.json", summary());
}

template <int dim>
void PrimalOutput<dim>::write_step(const PrimalReport<dim> &step)
{
  if (scene.output.vtu)
    write_solution(step);
  write_together(communicator,
                 [&]()
                 {
                   if (is_first)
                     write_tables(step); // last: they name no step whose files are missing
                 });
}

template <int dim>
void PrimalOutput<dim>::finish()
{
  status = "done";
  write_together(communicator,
                 [&]()
                 {
                   if (is_first)
                     write("summary.json", summary());
                 });
}

template <int dim>
void PrimalOutput<dim>::give_up(const std::string &new_status, const std::string &new_message)
{
  status = new_status;
  message = new_message;
  if (directory) // where it cannot be written, the message itself is what the user has to hear of
    directory->write("summary.json", summary());
}

template <int dim>
std::string PrimalOutput<dim>::summary() const
{
  return json_head(scene, status, stopped_by, message) +
         "  \"processes\": " + std::to_string(Utilities::MPI::n_mpi_processes(communicator)) +
         ",\n  \"steps\": " + std::to_string(rows.size()) +
         ",\n  \"final\": " + (rows.empty() ? "null" : json_object(rows.back())) + ",\n" + forces +
         json_tail(times, warnings, directory->files());
}

template class PrimalOutput<2>;
template class PrimalOutput<3>;
} // namespace hpvi
