// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/result_directory.h>
#include <hpvi/output/written_names.h>

#include <algorithm>

namespace hpvi
{
template <int dim>
std::string names_written(const Scene<dim> &scene, const unsigned int n_processes)
{
  const OutputSettings &output = scene.output;
  return results::always + (scene.has_load_history() ? "|" + results::loading : "") +
         (output.contact && scene.has_contact() ? "|" + results::contact : "") +
         (dim == 2 && output.mesh_picture ? "|" + results::mesh : "") +
         (!output.vtu        ? ""
          : n_processes == 1 ? "|" + results::vtu
                             : "|" + results::pieces) +
         (output.vtu && scene.has_contact() ? "|" + results::contact_line : "") +
         (output.reference ? "|" + results::reference : "") +
         (output.report ? "|" + results::report : "") +
         (std::any_of(scene.probes.begin(), scene.probes.end(),
                      [](const Probe<dim> &probe) { return probe.kind == ProbeKind::line; })
              ? "|" + results::probe
              : "");
}

template std::string names_written(const Scene<2> &, unsigned int);
template std::string names_written(const Scene<3> &, unsigned int);
} // namespace hpvi
