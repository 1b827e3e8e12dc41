// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>

#include <functional>

namespace hpvi
{
namespace
{
/** @p check of each load step in turn; what it refuses names the load step. */
template <int dim>
void check_load_steps(const Scene<dim> &scene, const std::function<void(unsigned int)> &check)
{
  for (unsigned int step = 1; step <= scene.loading.steps; ++step)
    try
    {
      check(step);
    }
    catch (const InputError &error)
    {
      if (step == 1 || error.names_time)
        throw;
      throw InputError(std::string(error.what()) + " (load step " + std::to_string(step) +
                           ", t = " + to_string(scene.loading.time(step)) + ")",
                       true);
    }
}

} // namespace

/** A history has no closed form here, and what one load step is compared with is none of another. */
template <int dim>
void check_load_history(const Scene<dim> &scene, const SceneUse use)
{
  const Loading<dim> &loading = scene.loading;
  const std::string history = "is one state, and Loading/Steps asks for a history; remove either";
  if (loading.steps < 1 || loading.steps > 10000 || !loading.at)
    reject(scene, "Loading", "Steps",
           "is no history; give an integer from 1 to 10000, and the scene of each load step",
           std::to_string(loading.steps));
  if (loading.until_steady != 0 &&
      !(loading.until_steady >= 1e-12 && loading.until_steady <= 0.5 && loading.maximum_cycles > 1))
    reject(scene, "Loading", "Until steady",
           "is no share; give a number from 1e-12 to 0.5, and two or more Maximum cycles",
           to_string(loading.until_steady));
  if (use == SceneUse::measure)
    reject(scene, "Loading", "Steps",
           "is a history, and the inf-sup constant is one of a mesh, whatever the load; remove it",
           std::to_string(loading.steps));
  if (scene.exact_solution)
    reject(scene, "Exact solution", "Solution", history);
  if (!scene.reference_solution.empty())
    reject(scene, "Error", "Reference solution", history);
  if (scene.output.reference)
    reject(scene, "Output", "Reference solution", history, "true");
  DataScale past;
  check_load_steps(scene,
                   [&](const unsigned int step)
                   {
                     const Scene<dim> next = load_step(scene, step, past);
                     check(next, use);
                     past = data_scale(next);
                   });
  if (past.stress == 0) // without data, or with none that is large enough to be squared
    check_load_steps(scene,
                     [&](const unsigned int step) { check(loading.at(loading.time(step)), use); });
}

template void check_load_history(const Scene<2> &, SceneUse);
template void check_load_history(const Scene<3> &, SceneUse);
} // namespace hpvi
