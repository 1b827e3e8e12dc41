// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/text.h>
#include <hpvi/output/contact_line.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/output.h>
#include <hpvi/output/probe_table.h>
#include <hpvi/output/vtu.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/scene_reader.h>
#include <hpvi/results/stored_solution.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Of the files that a run of @p scene writes, as the ResultDirectory wants them. */
template <int dim>
std::string names_written(const Scene<dim> &scene, const unsigned int n_processes)
{
  const OutputSettings &output = scene.output;
  return results::always + (scene.has_load_history() ? "|" + results::loading : "") +
         (output.contact && scene.has_contact() ? "|" + results::contact : "") +
         (!output.vtu        ? ""
          : n_processes == 1 ? "|" + results::vtu
                             : "|" + results::pieces) +
         (output.vtu && scene.has_contact() ? "|" + results::contact_line : "") +
         (output.reference ? "|" + results::reference : "") +
         (std::any_of(scene.probes.begin(), scene.probes.end(),
                      [](const Probe<dim> &probe) { return probe.kind == ProbeKind::line; })
              ? "|" + results::probe
              : "");
}

/**
 * Names and contents of the files with the number of a step that one process writes by itself, in the order in which they are written:
 * what the scene does not switch off. @p scene: that of the run, which knows whether there is a load history.
 */
template <int dim>
std::vector<std::pair<std::string, std::string>>
step_files(const Scene<dim> &scene, const StepReport<dim> &step, const unsigned int n_processes)
{
  const OutputSettings &output = scene.output;
  std::vector<std::pair<std::string, std::string>> files;
  const auto add =
      [&](const std::string &name, const std::string &suffix, const std::string &content)
  { files.emplace_back(numbered(name, step.number, suffix), content); };
  for (const ProbeLine<dim> &line : step.probe_lines)
    files.emplace_back(probe_file(scene, line, step.number), csv(probe_rows(line)));
  if (output.contact && scene.has_contact())
    add("contact", ".csv", csv(contact_rows(scene, step.contact)));
  if (output.vtu && scene.has_contact())
    add("contact", ".vtu", contact_line(scene, step.contact, step.number, step.history.contact));
  if (output.vtu && n_processes == 1)
    add("solution", ".vtu", vtu(step, {""}).piece);
  return files;
}

/** Name a file in `solution.pvd` or `contact.pvd`, by which ParaView opens all of them; @p time is the step, or the time of a history. */
void add_to_pvd(GrowingText &pvd, const double time, const std::string &file)
{
  const std::string head = "<?xml version=\"1.0\"?>\n"
                           "<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n",
                    end = "  </Collection>\n</VTKFile>\n";
  pvd.same = pvd.text.empty() ? 0 : pvd.text.size() - end.size();
  pvd.text.resize(pvd.same);
  pvd.text += (pvd.same == 0 ? head : "") + "    <DataSet timestep=\"" + text(time) +
              "\" part=\"0\" file=\"" + file + "\"/>\n" + end;
}

/**
 * Of the files of a step those that ParaView opens, each with the name of its collection: of a solution on several processes the file
 * that names the pieces.
 */
std::vector<std::pair<std::string, std::string>> collected(const std::vector<std::string> &files)
{
  static const std::regex pattern("(solution|contact)-[0-9]+\\.p?vtu");
  std::vector<std::pair<std::string, std::string>> result;
  for (const std::string &file : files)
    if (std::smatch match; std::regex_match(file, match, pattern))
      result.emplace_back(match[1].str() + ".pvd", file);
  return result;
}

/** The first @p n_steps steps of what @p pvd has, as if it had no more. */
GrowingText first_of_pvd(const std::string &pvd, const unsigned int n_steps)
{
  static const std::regex entry(
      "timestep=\"([^\"]+)\" part=\"0\" file=\"([a-z]+-([0-9]{2,9})\\.[a-z]+)\"");
  GrowingText result;
  for (std::sregex_iterator found(pvd.begin(), pvd.end(), entry), end; found != end; ++found)
    if (std::stoul((*found)[3]) <= n_steps)
      add_to_pvd(result, std::strtod((*found)[1].str().c_str(), nullptr), (*found)[2]);
  result.same = 0;
  return result;
}

/** collectively(), where what goes wrong is that something cannot be written. */
void write_together(MPI_Comm communicator, const std::function<void()> &work)
{
  try
  {
    collectively(communicator, work);
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
} // namespace

template <int dim>
Output<dim>::Output(const Scene<dim> &scene, const std::string &path, const unsigned int n_steps,
                    MPI_Comm communicator)
    : scene(scene), path(path), communicator(communicator), is_first(rank_of(communicator) == 0),
      n_processes(hpvi::n_processes(communicator))
{
  by_first([&]() { open(path, n_steps); });
}

/** All learn how it ends. */
template <int dim>
void Output<dim>::by_first(const std::function<void()> &work) const
{
  write_together(
      communicator, is_first ? work : []() {});
}

template <int dim>
void Output<dim>::open(const std::string &path, const unsigned int n_steps)
{
  directory = std::make_unique<ResultDirectory>(
      path, names_written(scene, n_processes),
      std::vector<std::string>{scene.parameters && n_steps == 0 ? scene.file : "",
                               scene.reference_solution});
  summary.processes = n_processes;
  summary.input_files = input_files_of(scene);
  try
  {
    if (n_steps > 0)
      take_up(n_steps);
    else
    {
      write_summary(); // names the files of earlier runs as long as there are any
      directory->remove_earlier();
    }
    if (scene.parameters)
    {
      announce({"scene.prm"});
      write("scene.prm", effective_parameters(scene));
    }
    write_summary(); // a run that was done stays so until its scene has the limits with which it goes on
  }
  catch (const InputError &error)
  {
    give_up(RunStatus::failed, error.what());
    throw;
  }
  is_usable = true;
}

/** What is there of steps that the state does not know will be there again. */
template <int dim>
void Output<dim>::take_up(const unsigned int n_steps)
{
  const std::filesystem::path home(path);
  summary.scene_file = directory->other_scene("");
  try
  {
    const std::vector<Record> rows =
        tables.take_up(n_steps, scene.has_load_history(),
                       [&](const std::string &name) { return content_of(home / name); });
    summary.take_up(rows, tables.loading.last);
  }
  catch (const InputError &error)
  {
    directory->reject(error.what());
  }
  take_up_pictures(n_steps);
  update_tables();
  if (!tables.loading.text.empty())
    update("loading.csv", tables.loading);
}

/** Of each step, or with OutputSteps::last of the last one and of the end of each load step. */
template <int dim>
void Output<dim>::take_up_pictures(const unsigned int n_steps)
{
  std::set<unsigned int> ends{n_steps};
  for (const Record &load_step : records(tables.loading.text))
    ends.insert(number_of(load_step, "step").value_or(0));
  const bool all = scene.output.steps == OutputSteps::all;
  const std::vector<std::string> of_step =
      directory->remove_after(n_steps, [&](const unsigned int step)
                              { return step <= n_steps && (all || ends.count(step) > 0); });
  if (!all && !scene.has_load_history())
    superseded = of_step;
  for (const std::string name : {"contact.pvd", "solution.pvd"})
    if (const GrowingText pvd =
            first_of_pvd(content_of(std::filesystem::path(path) / name), n_steps);
        !pvd.text.empty())
      update(name, collections[name] = pvd);
}

template <int dim>
void Output<dim>::announce(const std::vector<std::string> &names)
{
  bool any_new = false;
  for (const std::string &name : names)
    any_new = directory->add(name) || any_new;
  if (any_new)
    write_summary();
}

template <int dim>
void Output<dim>::write(const std::string &name, const std::string &content) const
{
  check(name, directory->write(name, content));
}

template <int dim>
void Output<dim>::update(const std::string &name, const GrowingText &content)
{
  check(name, directory->update(name, content.text, content.same));
}

template <int dim>
void Output<dim>::update_tables()
{
  update("convergence.csv", tables.convergence);
  update("degrees.csv", tables.degrees);
  update("forces.csv", tables.forces);
}

/** Pieces are written by processes that have no directory. */
template <int dim>
void Output<dim>::check(const std::string &name, const std::error_code &error) const
{
  if (!error)
    return;
  const std::string reason = name + " cannot be written: " + error.message();
  if (directory && !is_usable)
    directory->reject(reason);
  throw OutputFailure(
      (directory ? directory->name() : "output directory '" + printable(path) + "'") + ": " +
      reason + "; " + safe_steps());
}

template <int dim>
std::string Output<dim>::replaced_scene() const
{
  return directory ? directory->other_scene(scene.file) : "";
}

template <int dim>
std::string Output<dim>::safe_steps() const
{
  if (summary.steps == 0)
    return "no step is finished";
  const bool one = summary.steps == 1;
  return (one ? "step 1" : "steps 1 to " + std::to_string(summary.steps)) +
         (directory && directory->is_gone()
              ? (one ? " has" : " have") + std::string(" vanished with it")
              : (one ? " is" : " are") + std::string(" safe"));
}

/** The solution: of one process a file, of several a piece of each, which the first one announces and then names. */
template <int dim>
void Output<dim>::write_pieces(const StepReport<dim> &step)
{
  std::vector<std::string> pieces;
  for (unsigned int k = 0; k < n_processes; ++k)
    pieces.push_back(numbered("solution", step.number, "." + std::to_string(k) + ".vtu"));
  const Vtu content = vtu(step, pieces);
  const std::string index = numbered("solution", step.number, ".pvtu");
  pictures.insert(pictures.end(), pieces.begin(), pieces.end());
  pictures.push_back(index); // last: it names no piece that is missing
  by_first([&]() { announce(pictures); });
  const std::string &own = pieces[rank_of(communicator)];
  write_together(communicator,
                 [&]()
                 {
                   check(own,
                         write_whole(std::filesystem::path(path) / own, content.piece,
                                     ".hpvi." + std::to_string(rank_of(communicator)) + ".tmp"));
                 });
  by_first([&]() { write(index, content.index); });
}

template <int dim>
void Output<dim>::write_pictures(const StepReport<dim> &step)
{
  const auto files = step_files(scene, step, n_processes);
  std::vector<std::string> names;
  for (const auto &file : files)
    names.push_back(file.first);
  announce(names);
  for (const auto &[name, content] : files)
    write(name, content);
  pictures.insert(pictures.begin(), names.begin(), names.end());
}

/** A history is that of its load steps. */
template <int dim>
void Output<dim>::add_to_collections(const StepReport<dim> &step)
{
  const bool is_history = scene.has_load_history();
  if (!scene.output.vtu || (is_history && step.stopped_by.empty()))
    return;
  for (const auto &[name, file] : collected(pictures))
  {
    GrowingText &pvd = collections[name];
    if (scene.output.steps == OutputSteps::last && !is_history)
      pvd = {};
    add_to_pvd(pvd, is_history ? std::max(1U, step.load.cycle) - 1 + step.load.t : step.number,
               file);
    announce({name});
    update(name, pvd);
  }
}

template <int dim>
void Output<dim>::write_reference(const StepReport<dim> &step)
{
  std::ostringstream file;
  write_solution(file, step.field, step.energies.energy);
  by_first(
      [&]()
      {
        announce({"reference.dat"});
        write("reference.dat", file.str());
      });
}

/** What the load steps so far have done together: whole files, which each load step makes anew. */
template <int dim>
void Output<dim>::write_history(const StepReport<dim> &step)
{
  const auto add = [&](const std::string &name, const std::vector<Record> &rows)
  {
    announce({name});
    write(name, csv(rows));
  };
  if (scene.output.contact && scene.has_contact())
    add("contact-history.csv", contact_history_rows(scene, step.history.contact));
  if (!step.history.cycles.empty())
    add("cycles.csv", cycle_rows(step.history.cycles));
}

/** Last: the tables name no step whose files are missing. */
template <int dim>
void Output<dim>::write_tables(const StepReport<dim> &step,
                               const std::optional<RunState<dim>> &state)
{
  const bool is_last = !step.stopped_by.empty();
  tables.add(step);
  update_tables();
  if (scene.has_load_history() && is_last)
  {
    announce({"loading.csv"});
    update("loading.csv", tables.loading);
    write_history(step);
  }
  summary.add(step, tables.convergence.last);
  if (state)
  {
    std::ostringstream content;
    state->write(content);
    last_state = content.str();
    if (!is_last || (scene.has_load_history() && !step.load.is_last))
      write_state();
  }
  for (const std::string &name : superseded)
    directory->remove(name);
  superseded =
      scene.output.steps == OutputSteps::last && !is_last ? pictures : std::vector<std::string>();
  write_summary();
}

template <int dim>
void Output<dim>::write_step(const StepReport<dim> &step, const LoadHistory<dim> *const solver)
{
  // Of a larger mesh a state takes more than it saves: all numbers of all cells, from one process.
  constexpr types::global_dof_index largest_state = 300000; // unknowns
  const std::optional<RunState<dim>> state =
      solver && step.size.n_dofs <= largest_state ? solver->state() : std::nullopt;
  pictures.clear();
  if (scene.output.vtu && n_processes > 1)
    write_pieces(step);
  if (scene.output.reference && !step.stopped_by.empty())
    write_reference(step);
  by_first(
      [&]()
      {
        announce({"convergence.csv", "degrees.csv", "forces.csv"});
        if (state)
          announce({"state.dat"});
        write_pictures(step);
        add_to_collections(step);
        write_tables(step, state);
      });
}

template <int dim>
void Output<dim>::write_state()
{
  if (const std::string state = std::exchange(last_state, {}); !state.empty())
    write("state.dat", state);
}

/** The state comes after all else: there is nothing to finish where it says that nothing is left to do. */
template <int dim>
void Output<dim>::finish()
{
  summary.status = RunStatus::done;
  by_first(
      [&]()
      {
        write_summary();
        write_state();
      });
}

template <int dim>
void Output<dim>::give_up(const RunStatus status, const std::string &message)
{
  summary.status = status;
  summary.message = message;
  if (!directory)
    return;
  directory->write("summary.json", summary.json(scene, directory->files()));
}

template <int dim>
void Output<dim>::write_summary() const
{
  write("summary.json", summary.json(scene, directory->files()));
}

template class Output<2>;
template class Output<3>;
} // namespace hpvi
