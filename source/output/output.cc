// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/evaluation/stored_solution.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/mesh_picture.h>
#include <hpvi/output/output.h>
#include <hpvi/output/vtu.h>
#include <hpvi/scene/parameters.h>

#include <regex>
#include <sstream>

namespace hpvi
{
namespace
{
/** NAME-NN.SUFFIX; the number grows beyond two digits where it has to. */
std::string numbered(const std::string &name, const unsigned int step, const std::string &suffix)
{
  return name + (step < 10 ? "-0" : "-") + std::to_string(step) + suffix;
}
} // namespace

template <int dim>
Output<dim>::Output(const Scene<dim> &scene, const std::string &path)
    : scene(scene),
      directory(path, [this](const std::string &name) { return writes(name); },
                {scene.parameters ? scene.parameters->file_name() : "", scene.reference_solution})
{
  try
  {
    write_summary(); // names the files of earlier runs as long as there are any
    directory.remove_earlier();
    if (scene.parameters)
      write("scene.prm", scene.effective_parameters());
  }
  catch (const InputError &error)
  {
    give_up("failed", error.what());
    throw;
  }
  is_usable = true;
}

template <int dim>
bool Output<dim>::writes(const std::string &name) const
{
  const auto matches = [&name](const char *pattern)
  { return std::regex_match(name, std::regex(pattern)); };
  return matches("scene\\.prm|convergence\\.csv|degrees\\.csv|summary\\.json") ||
         (scene.has_load_history() && matches("loading\\.csv")) ||
         (scene.output.contact && scene.has_contact() && matches("contact-[0-9]{2,}\\.csv")) ||
         (scene.output.mesh_picture && matches("mesh-[0-9]{2,}\\.svg")) ||
         (scene.output.vtu && matches("solution(-[0-9]{2,}\\.vtu|\\.pvd)")) ||
         (scene.output.reference && matches("reference\\.dat"));
}

template <int dim>
void Output<dim>::write(const std::string &name, const std::string &content)
{
  if (directory.add(name))
    write_summary();
  replace(name, content);
}

template <int dim>
void Output<dim>::replace(const std::string &name, const std::string &content) const
{
  const std::error_code error = directory.write(name, content);
  if (!error)
    return;
  const std::string reason = name + " cannot be written: " + error.message();
  if (!is_usable)
    directory.reject(reason);
  throw OutputFailure(directory.name() + ": " + reason + "; " + safe_steps());
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

template <int dim>
void Output<dim>::write_step(const StepReport<dim> &step)
{
  if (scene.output.contact && scene.has_contact())
    write(numbered("contact", step.number, ".csv"), contact_table(scene, step.contact));
  if constexpr (dim == 2)
    if (scene.output.mesh_picture)
      write(numbered("mesh", step.number, ".svg"), mesh_picture(step));
  if (scene.output.vtu)
  {
    const std::string name = numbered("solution", step.number, ".vtu");
    write(name, vtu(step));
    if (!scene.has_load_history())
      vtu_files.emplace_back(step.number, name);
    else if (!step.stopped_by.empty()) // a history is that of its load steps
      vtu_files.emplace_back(step.load.t, name);
    write("solution.pvd", pvd(vtu_files));
  }
  if (scene.output.reference && !step.stopped_by.empty())
  {
    std::ostringstream file;
    StoredSolution<dim>(step.solution, step.energies.energy).write(file);
    write("reference.dat", file.str());
  }
  tables.add(step); // last: the tables name no step whose files are missing
  write("convergence.csv", tables.convergence());
  write("degrees.csv", tables.degrees());
  if (scene.has_load_history())
    write("loading.csv", tables.loading());
  summary.add(step, tables.last_row());
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
  replace("summary.json", summary.json(scene, directory.files()));
}

template class Output<2>;
} // namespace hpvi
