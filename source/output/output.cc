// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/evaluation/stored_solution.h>
#include <hpvi/input/parameters.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/mesh_picture.h>
#include <hpvi/output/output.h>
#include <hpvi/output/vtu.h>

#include <sstream>

namespace hpvi
{
namespace
{
/** As the ResultDirectory wants them. */
template <int dim>
std::string names_written(const Scene<dim> &scene)
{
  const OutputSettings &output = scene.output;
  return results::always + (scene.has_load_history() ? "|" + results::loading : "") +
         (output.contact && scene.has_contact() ? "|" + results::contact : "") +
         (output.mesh_picture ? "|" + results::mesh : "") + (output.vtu ? "|" + results::vtu : "") +
         (output.reference ? "|" + results::reference : "");
}
} // namespace

template <int dim>
Output<dim>::Output(const Scene<dim> &scene, const std::string &path)
    : scene(scene),
      directory(path, names_written(scene),
                {scene.parameters ? scene.parameters->file_name() : "", scene.reference_solution})
{
  try
  {
    write_summary(); // names the files of earlier runs as long as there are any
    directory.remove_earlier();
    if (scene.parameters)
    {
      announce({"scene.prm"});
      write("scene.prm", scene.effective_parameters());
    }
  }
  catch (const InputError &error)
  {
    give_up("failed", error.what());
    throw;
  }
  is_usable = true;
}

template <int dim>
void Output<dim>::announce(const std::vector<std::string> &names)
{
  bool any_new = false;
  for (const std::string &name : names)
    any_new = directory.add(name) || any_new;
  if (any_new)
    write_summary();
}

template <int dim>
void Output<dim>::write(const std::string &name, const std::string &content) const
{
  check(name, directory.write(name, content));
}

template <int dim>
void Output<dim>::update(const std::string &name, const GrowingText &content)
{
  check(name, directory.update(name, content.text, content.same));
}

template <int dim>
void Output<dim>::check(const std::string &name, const std::error_code &error) const
{
  if (!error)
    return;
  const std::string reason = name + " cannot be written: " + error.message();
  if (!is_usable)
    directory.reject(reason);
  throw OutputFailure(directory.name() + ": " + reason + "; " + safe_steps());
}

template <int dim>
std::string Output<dim>::replaced_scene() const
{
  return directory.other_scene(scene.parameters ? scene.parameters->file_name() : "");
}

template <int dim>
std::string Output<dim>::safe_steps() const
{
  if (summary.steps == 0)
    return "no step is finished";
  const bool one = summary.steps == 1;
  return (one ? "step 1" : "steps 1 to " + std::to_string(summary.steps)) +
         (directory.is_gone() ? (one ? " has" : " have") + std::string(" vanished with it")
                              : (one ? " is" : " are") + std::string(" safe"));
}

/** The files with the number of the step; their names. */
template <int dim>
std::vector<std::string> Output<dim>::write_pictures(const StepReport<dim> &step)
{
  const OutputSettings &output = scene.output;
  const std::string contact_name = numbered("contact", step.number, ".csv"),
                    mesh_name = numbered("mesh", step.number, ".svg"),
                    vtu_name = numbered("solution", step.number, ".vtu");
  std::vector<std::string> names;
  if (output.contact && scene.has_contact())
    names.push_back(contact_name);
  if (output.mesh_picture)
    names.push_back(mesh_name);
  if (output.vtu)
    names.push_back(vtu_name);
  announce(names);
  if (output.contact && scene.has_contact())
    write(contact_name, contact_table(scene, step.contact));
  if (output.mesh_picture)
    write(mesh_name, mesh_picture(step));
  if (output.vtu)
    write(vtu_name, vtu(step));
  return names;
}

template <int dim>
void Output<dim>::write_step(const StepReport<dim> &step)
{
  const bool only_last = scene.output.steps == OutputSteps::last,
             is_last = !step.stopped_by.empty(), is_history = scene.has_load_history();
  announce({"convergence.csv", "degrees.csv"});
  const std::vector<std::string> pictures = write_pictures(step);
  if (scene.output.vtu && (is_last || !is_history)) // a history is that of its load steps
  {
    if (only_last && !is_history)
      pvd = {};
    add_to_pvd(pvd, is_history ? step.load.t : step.number, pictures.back());
    announce({"solution.pvd"});
    update("solution.pvd", pvd);
  }
  if (scene.output.reference && is_last)
  {
    std::ostringstream file;
    StoredSolution<dim>(step.solution, step.energies.energy).write(file);
    announce({"reference.dat"});
    write("reference.dat", file.str());
  }
  tables.add(step); // last: the tables name no step whose files are missing
  update("convergence.csv", tables.convergence());
  update("degrees.csv", tables.degrees());
  if (is_history && is_last)
  {
    announce({"loading.csv"});
    update("loading.csv", tables.loading());
  }
  summary.add(step, tables.last_row());
  for (const std::string &name : superseded)
    directory.remove(name);
  superseded = only_last && !is_last ? pictures : std::vector<std::string>();
  write_summary();
}

template <int dim>
void Output<dim>::finish()
{
  summary.status = "done";
  write_summary();
}

template <int dim>
void Output<dim>::give_up(const std::string &status, const std::string &message)
{
  summary.status = status;
  summary.message = message;
  try
  {
    write_summary();
  }
  catch (const std::runtime_error &)
  {
    // the message itself is what the user has to hear of
  }
}

template <int dim>
void Output<dim>::write_summary() const
{
  write("summary.json", summary.json(scene, directory.files()));
}

template class Output<2>;
} // namespace hpvi
