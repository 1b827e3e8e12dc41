// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/contact_line.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/mesh_picture.h>
#include <hpvi/output/probe_table.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/output/step_files.h>
#include <hpvi/output/vtu.h>

namespace hpvi
{
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
    files.emplace_back(probe_file(scene, line, step.number), probe_table(line));
  if (output.contact && scene.has_contact())
    add("contact", ".csv", contact_table(scene, step.contact));
  if constexpr (dim == 2)
    if (output.mesh_picture && n_processes == 1)
      add("mesh", ".svg", mesh_picture(step));
  if (output.vtu && scene.has_contact())
    add("contact", ".vtu", contact_line(scene, step.contact, step.number));
  if (output.vtu && n_processes == 1)
    add("solution", ".vtu", vtu(step, {""}).piece);
  return files;
}

template std::vector<std::pair<std::string, std::string>>
step_files(const Scene<2> &, const StepReport<2> &, unsigned int);
template std::vector<std::pair<std::string, std::string>>
step_files(const Scene<3> &, const StepReport<3> &, unsigned int);
} // namespace hpvi
