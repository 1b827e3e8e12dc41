// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_run_h
#define hpvi_run_h

#include <hpvi/output/output.h>
#include <hpvi/scene/scene.h>

#include <functional>
#include <string>

namespace hpvi
{
/** Who hears of a run while it lasts. */
template <int dim>
struct RunListener
{
  std::function<void(const Progress &)> on_stage;        ///< a stage; may throw to give up
  std::function<void(const Output<dim> &)> begun;        ///< files are written from now on
  std::function<void(const StepReport<dim> &)> finished; ///< before the files of the step
};

/** Runs a scene and prints nothing: the files that run() leaves are those of this. Throws likewise. */
template <int dim>
void run_silently(const Scene<dim> &scene, const std::string &directory,
                  const RunListener<dim> &listener);

/**
 * Runs a scene on all processes that were started: a row for each step, then what became of contact, supports and
 * balance; files into @p directory. Throws InputError, NumericalFailure, OutputFailure or Interruption.
 */
template <int dim>
void run(const Scene<dim> &scene, const std::string &directory);

/** Goes on after the last step whose state @p directory has. */
template <int dim>
void resume(const Scene<dim> &scene, const std::string &directory);
} // namespace hpvi

#endif
