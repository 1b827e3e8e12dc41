// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_adaptive_solver_h
#define hpvi_adaptive_solver_h

#include <hpvi/base/numerical_failure.h>
#include <hpvi/driver/checkpoint.h>
#include <hpvi/driver/step_report.h>

#include <functional>
#include <memory>
#include <optional>

namespace hpvi
{
template <int dim>
struct StepStages;

/**
 * SOLVE => ESTIMATE => MARK => REFINE (thesis, Section 4.3) for one scene, by the backend that
 * SolverSettings::path asks for. Owns the stages; prints nothing and writes no file: each finished step
 * goes to a callback. On several processes all functions are collective.
 */
template <int dim>
class AdaptiveSolver
{
public:
  using Announce = std::function<void(const Progress &)>;

  /**
   * Throws InputError where the scene does not pass check(), is not for the path that it asks for, or has a
   * load history, which is for LoadHistory.
   */
  explicit AdaptiveSolver(const Scene<dim> &scene, MPI_Comm communicator = MPI_COMM_SELF);

  /**
   * The same for the next load step of a history, on the mesh of @p last, which hands over what it keeps; slip is
   * counted from @p past.
   */
  AdaptiveSolver(const Scene<dim> &scene, AdaptiveSolver &last, const PastSlip<dim> &past);

  /**
   * Goes on after the step in which @p state was taken, to the same numbers as if the run had not been
   * broken off. Throws InputError where @p scene is not that of the state, limits, output and labels
   * aside, or where its limits leave no step to take. In a history of loads @p scene is that of the load step which
   * has ended in the state: then there is only the next one to go on with.
   */
  AdaptiveSolver(const Scene<dim> &scene, const RunState<dim> &state,
                 MPI_Comm communicator = MPI_COMM_SELF);

  ~AdaptiveSolver();

  /**
   * The beginning of run(), up to the last that the first step asks the functions of the scene for. Throws
   * InputError where they are no good between the points at which check() has tried them.
   */
  void prepare(const Announce &on_stage = [](const Progress &) {});

  /**
   * Runs until a limit of the scene is reached; @p on_stage hears of every stage before it begins, and
   * may throw to give up the step. With several threads it hears of the next step before @p finished_step has
   * this one, for one thread solves that meanwhile. Until it returns, in the callbacks too, dense algebra has
   * OneThread. Throws NumericalFailure.
   */
  void run(
      const std::function<void(const StepReport<dim> &)> &finished_step,
      const Announce &on_stage = [](const Progress &) {});

  /**
   * What it takes to go on after the step at hand; to be asked while its callback lasts. At the end of a load step with
   * what those leave that are @p finished.
   */
  RunState<dim> state(const std::optional<FinishedLoads> &finished = std::nullopt) const;

  /** Of the last step, that of the state from which it goes on; none on the primal path. */
  std::optional<ReducedPart<dim>> reduced() const;

private:
  std::unique_ptr<StepStages<dim>> stages;
};
} // namespace hpvi

#endif
