// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_adaptive_solver_h
#define hpvi_adaptive_solver_h

#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/progress.h>
#include <hpvi/driver/backend.h>
#include <hpvi/driver/checkpoint.h>
#include <hpvi/driver/mean_intervals.h>
#include <hpvi/driver/step_report.h>
#include <hpvi/scene/data_scale.h>

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * SOLVE => ESTIMATE => MARK => REFINE (thesis, Section 4.3) for one scene, by the backend that
 * SolverSettings::path asks for, which has what belongs to a mesh. Prints nothing and writes no file: each finished step
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

  /** By a backend that has a mesh, for a @p scene that has passed check(). */
  AdaptiveSolver(const Scene<dim> &scene, std::unique_ptr<Backend<dim>> backend);

  AdaptiveSolver(const AdaptiveSolver &) = delete; // stages are announced by this one

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
  void set_callback(const Announce &listener);
  void announce(Backend<dim> &of);
  void run_steps(const std::function<void(const StepReport<dim> &)> &finished_step);
  void solve();
  void estimate_error();
  bool has_late_bound() const;
  BoundOfStep bound_of_step() const;
  const BoundOfStep &known_bound() const;
  Refinement mark() const;
  double part_of_next_step() const;
  PastStep<dim> past_step() const;
  StepReport<dim> decide_and_report();
  void solve_next_beside(const std::function<void()> &report);
  StepReport<dim> report();
  Stop end_of_run() const;
  void add_results(StepReport<dim> &step);
  void add_bound(StepReport<dim> &step);
  void compare_claims(StepReport<dim> &step);
  void conclude(StepReport<dim> &step);
  void count(StepReport<dim> &step);
  void refine();
  void resume(const RunState<dim> &state);

  const Scene<dim> &scene;
  std::unique_ptr<Backend<dim>> backend;
  std::unique_ptr<Backend<dim>> next; ///< for the next step, if that is solved
  std::exception_ptr next_failure;    ///< of it, which must not keep this one from being told
  bool is_solved = false;             ///< it was next
  Announce on_stage;
  const TrueError<dim> true_error;
  MeanIntervals<dim> mean_intervals;
  DataScale data;
  ErrorEstimate estimate; ///< of the current step, as all that follows
  EstimateNorms norms;
  Energies energies;
  std::optional<BoundOfStep> bound; ///< none: it may still be asked for
  Refinement refinement;
  History<dim> history;                     ///< of the steps that are solved
  std::vector<MeshMarks> refinements;       ///< from the coarse mesh to that of the current step
  mutable std::vector<std::string> entries; ///< of the scene, once a state() is asked for
};
} // namespace hpvi

#endif
