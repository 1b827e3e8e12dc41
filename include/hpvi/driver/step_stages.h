// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_step_stages_h
#define hpvi_step_stages_h

#include <hpvi/base/progress.h>
#include <hpvi/driver/backend.h>
#include <hpvi/driver/checkpoint.h>
#include <hpvi/driver/mean_intervals.h>
#include <hpvi/driver/step_report.h>
#include <hpvi/scene/data_scale.h>

#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * The next step, solved while the thread pool still finds out what is to be told of this one: the bound needs this mesh and its
 * solution, the next solution neither, so that two threads have work all the time.
 */
template <int dim>
class PipelinedStep
{
public:
  /**
   * Solves @p next on the calling thread, which is the one that hears of stages, beside @p report of @p here, whose own stages are silent.
   * Seconds of both are shares of the time that they take together. Throws what report() throws.
   */
  PipelinedStep(std::unique_ptr<Backend<dim>> next, Backend<dim> &here,
                const std::function<void()> &report);

  /** The next step in the place of this one; throws what solving it has thrown. */
  std::unique_ptr<Backend<dim>> take();

private:
  std::unique_ptr<Backend<dim>> next;
  std::exception_ptr failure; ///< of the next step, which must not keep this one from being told
};

/** The stages of one step after the other, and what they share. What belongs to a mesh is the backend's. Functions are collective. */
template <int dim>
struct StepStages
{
  const Scene<dim> &scene;
  std::unique_ptr<Backend<dim>> backend;
  std::unique_ptr<PipelinedStep<dim>> ahead; ///< the next step, if it is solved
  bool is_solved = false;                    ///< it was ahead
  std::function<void(const Progress &)> on_stage;
  const TrueError<dim> true_error;
  MeanIntervals<dim> mean_intervals;
  DataScale data;
  ErrorEstimate estimate; ///< of the current step, as all that follows
  EstimateNorms norms;
  Energies energies;
  BoundOfStep bound;
  bool is_bound_open = false; ///< it may still be asked for
  Refinement refinement;
  History<dim> history;               ///< of the steps that are solved
  std::vector<MeshMarks> refinements; ///< from the coarse mesh to that of the current step
  std::vector<std::string> entries;   ///< of the scene, once a state() is asked for

  StepStages(const Scene<dim> &scene, std::unique_ptr<Backend<dim>> backend)
      : scene(scene), backend(std::move(backend)), true_error(scene), mean_intervals(scene)
  {
    collectively(this->backend->communicator, [&]() { data = data_scale(scene); });
  }

  void set_callback(const std::function<void(const Progress &)> &listener);
  void announce(Backend<dim> &of);
  void solve();
  void estimate_error();
  double hysteresis() const;
  bool has_late_bound() const;
  bool asks_for_bound(const StepReport<dim> &step) const;
  void compute_bound();
  void bound_unless_late();
  Refinement mark() const;
  PastStep<dim> past_step() const;
  bool goes_on() const;
  StepReport<dim> decide_and_report();
  StepReport<dim> report();
  std::string end_of_run() const;
  void add_results(StepReport<dim> &step);
  void add_bound(StepReport<dim> &step);
  void compare_claims(StepReport<dim> &step);
  void conclude(StepReport<dim> &step);
  void count(StepReport<dim> &step);
  void refine();
  void resume(const RunState<dim> &state);
};
} // namespace hpvi

#endif
