// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/input/parameters.h>
#include <hpvi/output/contact_report.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/output.h>
#include <hpvi/output/primal_output.h>
#include <hpvi/output/tables.h>
#include <hpvi/output/vtu.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace hpvi
{
using namespace dealii;

namespace
{
/** As the ResultDirectory wants them. */
template <int dim>
std::string names_written(const Scene<dim> &scene)
{
  return results::always +
         (scene.output.contact && scene.has_contact() ? "|" + results::contact : "") +
         (scene.output.vtu ? "|" + results::pieces : "");
}

std::string known(const double value)
{
  return std::isfinite(value) ? text(value) : "";
}

/** Nothing where no contact can be penetrated. */
template <int dim>
std::string penetration_json(const BoundaryCondition<dim> &boundary,
                             const Penetration<dim> &penetration)
{
  if (!boundary.is_unilateral())
    return "";
  return ",\n      \"largest_penetration\": " + json_number(penetration.depth) +
         ",\n      \"largest_penetration_at\": " +
         (penetration.depth > 0 ? json_point<dim>(penetration.x) : "null");
}

/** As in summary.json: force, pressure and zones of each contact boundary. */
template <int dim>
std::string contact_json(const Scene<dim> &scene, const std::vector<MomentPoint<dim>> &points,
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
            ": {\n      \"normal_resultant\": " + json_number(normal) +
            ",\n      \"friction_resultant\": " + json_point<dim>(friction) +
            ",\n      \"largest_pressure\": " + json_number(pressure) +
            ",\n      \"largest_pressure_at\": " + (pressure > 0 ? json_point<dim>(at) : "null") +
            penetration_json(boundary, penetrations[boundary.id]) +
            ",\n      \"area\": " + json_number(area) +
            ",\n      \"open_area\": " + json_number(open) +
            ",\n      \"slipping_area\": " + json_number(slipping) + "\n    }";
  }
  return "{" + list + (list.empty() ? "}" : "\n  }");
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
            path, names_written(scene),
            std::vector<std::string>{scene.parameters ? scene.parameters->file_name() : ""});
        summary.processes = Utilities::MPI::n_mpi_processes(communicator);
        write_summary();
        directory->remove_earlier();
        if (scene.parameters)
        {
          announce({"scene.prm"});
          write("scene.prm", scene.effective_parameters());
        }
        is_usable = true;
      });
}

template <int dim>
void PrimalOutput<dim>::announce(const std::vector<std::string> &names)
{
  bool any_new = false;
  for (const std::string &name : names)
    any_new = directory->add(name) || any_new;
  if (any_new)
    write_summary();
}

template <int dim>
void PrimalOutput<dim>::write(const std::string &name, const std::string &content) const
{
  check(name, directory->write(name, content));
}

template <int dim>
void PrimalOutput<dim>::update(const std::string &name, const GrowingText &content)
{
  check(name, directory->update(name, content.text, content.same));
}

template <int dim>
void PrimalOutput<dim>::check(const std::string &name, const std::error_code &error) const
{
  if (!error)
    return;
  const std::string reason = name + " cannot be written: " + error.message();
  if (directory && !is_usable)
    directory->reject(reason);
  throw OutputFailure("output directory '" + printable(path) + "': " + reason + "; " +
                      safe_steps());
}

template <int dim>
std::string PrimalOutput<dim>::replaced_scene() const
{
  return directory && scene.parameters ? directory->other_scene(scene.parameters->file_name()) : "";
}

template <int dim>
std::string PrimalOutput<dim>::safe_steps() const
{
  if (summary.steps == 0)
    return "no step is finished";
  return summary.steps == 1 ? "step 1 is safe"
                            : "steps 1 to " + std::to_string(summary.steps) + " are safe";
}

/** Each process writes its piece, the first one announces them all. */
template <int dim>
void PrimalOutput<dim>::write_solution(const PrimalReport<dim> &step)
{
  const unsigned int n = Utilities::MPI::n_mpi_processes(communicator),
                     rank = Utilities::MPI::this_mpi_process(communicator);
  std::vector<std::string> pieces;
  for (unsigned int k = 0; k < n; ++k)
    pieces.push_back(numbered("solution", step.number, "." + std::to_string(k) + ".vtu"));
  const PrimalVtu content = vtu(step, pieces);
  const std::string name = numbered("solution", step.number, ".pvtu");
  pictures = pieces;
  pictures.push_back(name);
  write_together(communicator,
                 [&]()
                 {
                   if (is_first)
                     announce(pictures);
                 });
  write_together(communicator,
                 [&]()
                 {
                   check(pieces[rank],
                         write_whole(std::filesystem::path(path) / pieces[rank], content.piece,
                                     ".hpvi." + std::to_string(rank) + ".tmp"));
                 });
  write_together(communicator,
                 [&]()
                 {
                   if (!is_first)
                     return;
                   write(name, content.index); // last: it names no piece that is missing
                   if (scene.output.steps == OutputSteps::last)
                     pvd = {};
                   add_to_pvd(pvd, step.number, name);
                   announce({"solution.pvd"});
                   update("solution.pvd", pvd);
                 });
}

template <int dim>
void PrimalOutput<dim>::write_tables(const PrimalReport<dim> &step)
{
  announce({"convergence.csv", "degrees.csv"});
  if (scene.output.contact && scene.has_contact())
  {
    pictures.push_back(numbered("contact", step.number, ".csv"));
    announce({pictures.back()});
    write(pictures.back(), contact_table(scene, step.contact));
  }
  const Record row = convergence_record(step);
  Record counts{{"step", text(step.number)}, {"elements", std::to_string(step.n_cells)}};
  for (unsigned int p = 1; p <= step.space.tables.degree; ++p)
    counts.emplace_back("p" + text(p),
                        p < step.space.tables.degree ? "0" : std::to_string(step.n_cells));
  add_row(convergence, row);
  add_row(degrees, counts);
  update("convergence.csv", convergence);
  update("degrees.csv", degrees);
  count(step, row);
  for (const std::string &name : superseded)
    directory->remove(name);
  write_summary();
}

template <int dim>
void PrimalOutput<dim>::count(const PrimalReport<dim> &step, const Record &row)
{
  summary.steps = step.number;
  summary.last_row = row;
  summary.times += step.times;
  summary.stopped_by = step.stopped_by;
  summary.warnings = step.warnings;
  if (!step.stopped_by.empty())
    summary.ending = {"null", json_string("the primal path has no guaranteed bound of the error"),
                      forces_json(step.equilibrium), balance_json(step.equilibrium),
                      contact_json(scene, step.contact, step.penetrations)};
}

template <int dim>
void PrimalOutput<dim>::write_step(const PrimalReport<dim> &step)
{
  pictures.clear();
  if (scene.output.vtu)
    write_solution(step);
  write_together(communicator,
                 [&]()
                 {
                   if (is_first)
                     write_tables(step); // last: they name no step whose files are missing
                 });
  if (scene.output.steps == OutputSteps::last)
    superseded = pictures;
}

template <int dim>
void PrimalOutput<dim>::finish()
{
  summary.status = "done";
  write_together(communicator,
                 [&]()
                 {
                   if (is_first)
                     write_summary();
                 });
}

template <int dim>
void PrimalOutput<dim>::give_up(const std::string &status, const std::string &message)
{
  summary.status = status;
  summary.message = message;
  if (directory) // where it cannot be written, the message itself is what the user has to hear of
    directory->write("summary.json", summary.json(scene, directory->files()));
}

template <int dim>
void PrimalOutput<dim>::write_summary() const
{
  write("summary.json", summary.json(scene, directory->files()));
}

template class PrimalOutput<2>;
template class PrimalOutput<3>;
} // namespace hpvi
