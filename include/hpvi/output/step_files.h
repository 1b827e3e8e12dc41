// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_step_files_h
#define hpvi_step_files_h

#include <hpvi/driver/step_report.h>

#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * Names and contents of the files with the number of a step that one process writes by itself, in the order in which they are written:
 * what the scene does not switch off. @p scene: that of the run, which knows whether there is a load history.
 */
template <int dim>
std::vector<std::pair<std::string, std::string>>
step_files(const Scene<dim> &scene, const StepReport<dim> &step, unsigned int n_processes);
} // namespace hpvi

#endif
