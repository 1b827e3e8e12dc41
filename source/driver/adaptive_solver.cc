// SPDX-License-Identifier: LGPL-2.1-or-later

// Solve, estimate, mark, refine: this file is the loop, and all other files are what it calls. Each pass is one <i>step</i>: a
// mesh with degrees goes in, a solution with an estimate of its error comes out, and so does the next mesh. Whether a step is
// solved on the contact boundary, by a dense program, or in the whole body, on many processes, is the business of a
// <i>backend</i>; the loop is the same, and so is all that it says of a solution.
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/processes.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/driver/step_stages.h>
#include <hpvi/driver/thickness.h>
#include <hpvi/driver/threads.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** It may have been built by code, or changed since it was read. */
template <int dim>
void check_one_problem(const Scene<dim> &scene)
{
  if (scene.has_load_history())
    throw InputError(scene.origin() + ": Loading/Steps: asks for a history, of which this is one "
                                      "load step only; run it by LoadHistory, or remove it");
  check(scene);
}

template <int dim>
std::unique_ptr<Backend<dim>> checked_backend(const Scene<dim> &scene, MPI_Comm communicator)
{
  collectively(communicator, [&]() { check_one_problem(scene); });
  return make_backend(scene, communicator);
}
} // namespace

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, MPI_Comm communicator)
    : stages(std::make_unique<StepStages<dim>>(scene, checked_backend(scene, communicator)))
{
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, AdaptiveSolver &last,
                                    const PastSlip<dim> &past)
{
  check_one_problem(scene);
  stages =
      std::make_unique<StepStages<dim>>(scene, last.stages->backend->next_load_step(scene, past));
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, const RunState<dim> &state,
                                    MPI_Comm communicator)
    : AdaptiveSolver(scene, communicator)
{
  const ThreadPool pool = thread_pool_of(stages->scene, communicator); // as in run()
  stages->set_callback([](const Progress &) {});
  state.require_scene(scene, hpvi::n_processes(communicator));
  // Where a load step has ended nothing is left to mark, and element matrices are the next one's.
  if (!state.loads)
    stages->resume(state);
  else if (!stages->backend->restore_end(state.refinements, state.values))
    RunState<dim>::format().reject(state.name,
                                   "the run state has another coarse mesh or number of unknowns");
}

template <int dim>
AdaptiveSolver<dim>::~AdaptiveSolver() = default;

template <int dim>
RunState<dim> AdaptiveSolver<dim>::state(const std::optional<FinishedLoads> &finished) const
{
  StepStages<dim> &all = *stages;
  if (all.entries.empty())
    all.entries = RunState<dim>::entries_of(all.scene, n_processes(all.backend->communicator));
  return {"the run state",
          all.entries,
          finished ? all.backend->refinement_history() : all.refinements,
          all.backend->values(),
          finished ? History<dim>() : all.history,
          finished};
}

template <int dim>
std::optional<ReducedPart<dim>> AdaptiveSolver<dim>::reduced() const
{
  return stages->backend->reduced();
}

/** Before anything is reported or written. */
template <int dim>
void AdaptiveSolver<dim>::prepare(const Announce &on_stage)
{
  const ThreadPool pool = thread_pool_of(stages->scene, stages->backend->communicator);
  stages->set_callback(on_stage);
  stages->backend->discretise();
}

// @sect3{The loop}
//
// After so much preparation it reads as it is told. The report goes out before refinement, so that whoever listens may write
// files, stop, or change nothing; and a step whose mesh would not change again is the last one.
namespace
{
template <int dim>
void run_steps(StepStages<dim> &stages,
               const std::function<void(const StepReport<dim> &)> &finished_step)
{
  for (bool finished = false; !finished;)
  {
    stages.solve();
    stages.estimate_error();
    StepReport<dim> step = stages.decide_and_report();
    step.stopped_by = stages.end_of_run();
    if (stages.asks_for_bound(step))
    {
      stages.compute_bound();
      stages.add_bound(step);
      stages.count(step);
      step.stopped_by = stages.end_of_run();
    }
    finished = !step.stopped_by.empty();
    if (finished)
      stages.conclude(step);
    take_thickness(step);
    finished_step(step);
    if (!finished)
      stages.refine();
  }
}
} // namespace

template <int dim>
void AdaptiveSolver<dim>::run(const std::function<void(const StepReport<dim> &)> &finished_step,
                              const Announce &on_stage)
{
  const ThreadPool pool = thread_pool_of(stages->scene, stages->backend->communicator);
  stages->set_callback(on_stage);
  try
  {
    run_steps(*stages, finished_step);
  }
  catch (const MemoryFailure &failure)
  {
    throw MemoryFailure(in_entries_of(stages->scene, failure.what()));
  }
  catch (const NumericalFailure &failure)
  {
    throw NumericalFailure(in_entries_of(stages->scene, failure.what()));
  }
  stages->ahead.reset();
}

template class AdaptiveSolver<2>;
template class AdaptiveSolver<3>;
} // namespace hpvi
