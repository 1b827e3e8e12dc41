// SPDX-License-Identifier: LGPL-2.1-or-later

// Solve, estimate, mark, refine: this file is the loop, and all other files are what it calls. Each pass is one <i>step</i>: a
// mesh with degrees goes in, a solution with an estimate of its error comes out, and so does the next mesh. Whether a step is
// solved on the contact boundary, by a dense program, or in the whole body, on many processes, is the business of a
// <i>backend</i>; the loop is the same, and so is all that it says of a solution.
#include <hpvi/adaptivity/adaptive_solver.h>
#include <hpvi/adaptivity/all_cells.h>
#include <hpvi/adaptivity/column_width.h>
#include <hpvi/adaptivity/conclusion.h>
#include <hpvi/adaptivity/late_bound.h>
#include <hpvi/adaptivity/limits.h>
#include <hpvi/adaptivity/marking.h>
#include <hpvi/adaptivity/mean_intervals.h>
#include <hpvi/adaptivity/thickness.h>
#include <hpvi/backends/threads.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/processes.h>
#include <hpvi/scene/data_scale.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hpvi
{
using namespace dealii;

// @sect3{What the stages share}
//
// What belongs to a mesh is the backend's. The loop keeps numbers of each step, and the marks that have led to the current mesh.
template <int dim>
struct AdaptiveSolver<dim>::Stages
{
  const Scene<dim> &scene;
  const std::unique_ptr<Backend<dim>> backend;
  const TrueError<dim> true_error;
  MeanIntervals<dim> mean_intervals;
  DataScale data;
  ErrorEstimate estimate; ///< of the current step, as the next
  BoundOfStep bound;
  bool is_bound_open = false;         ///< it may still be asked for
  History<dim> history;               ///< of the finished steps
  std::vector<MeshMarks> refinements; ///< from the coarse mesh to that of the current step
  std::vector<std::string> entries;   ///< of the scene, once a state() is asked for

  Stages(const Scene<dim> &scene, std::unique_ptr<Backend<dim>> backend)
      : scene(scene), backend(std::move(backend)), true_error(scene), mean_intervals(scene)
  {
    together(this->backend->communicator, [&]() { data = data_scale(scene); });
  }

  void hear(const Announce &about_to);
  void measure(double own_stress);
  bool asks_for_bound(const StepReport<dim> &step) const;
  void close_bound();
  Refinement mark() const;
  PastStep<dim> past_step(const EstimateNorms &norms, const Energies &energies) const;
  StepReport<dim> report();
  std::string end_of_run(const Refinement &refinement) const;
  void add_results(StepReport<dim> &step);
  void add_bound(StepReport<dim> &step);
  void refine(const Refinement &refinement);
  void resume(const RunState<dim> &state);
};

// Every stage announces itself before it begins; the library itself prints nothing.
template <int dim>
void AdaptiveSolver<dim>::Stages::hear(const Announce &about_to)
{
  backend->about_to = [this, about_to](const std::string &stage, const std::string &note) {
    about_to({static_cast<unsigned int>(history.size()) + 1, stage, note});
  };
}

// @sect3{Estimate}
//
// Two answers to two questions. The residual indicator $\eta_K$ (4.50) says where the error is,
// costs next to nothing and exists for every scene. The guaranteed bound says how large the error
// is at most, and costs half of a step; where the last one alone shall have it, it waits for the limits.
/** @p own_stress: that of the step before. */
template <int dim>
void AdaptiveSolver<dim>::Stages::measure(const double own_stress)
{
  estimate = backend->estimate();
  is_bound_open = scene.error_bound && scene.error_bound_last && backend->reduced();
  bound = is_bound_open ? open_bound() : backend->bound(own_stress);
}

/** Where it is open: nothing follows, or it may be the end of the run. */
template <int dim>
bool AdaptiveSolver<dim>::Stages::asks_for_bound(const StepReport<dim> &step) const
{
  return is_bound_open && (!step.stopped_by.empty() || may_meet_tolerance(scene, history));
}

template <int dim>
void AdaptiveSolver<dim>::Stages::close_bound()
{
  bound = backend->bound(0.);
  is_bound_open = false;
}

// @sect3{Mark}
//
// The strategy sees numbers only: degrees, indicators, and on demand the decay rate of a cell,
// which costs a transformation of its coefficients and is asked for marked cells alone. Some
// things override it, because no indicator can see them.
template <int dim>
Refinement AdaptiveSolver<dim>::Stages::mark() const
{
  backend->begin("deciding on h and p");
  StageTimer timer(backend->times.decide);
  const bool by_bound = scene.adaptivity.indicator == Indicator::bound && bound.bound;
  Refinement refinement =
      hpvi::mark(scene.adaptivity, backend->degrees(),
                 by_bound ? bound.bound->indicators() : of_all_cells(estimate, backend->field()),
                 [&](const unsigned int cell) { return backend->decay_rate(cell); });
  if (scene.adaptivity.method != Method::pu)
    backend->mark_unresolved(refinement);
  return refinement;
}

// @sect3{Refine}
template <int dim>
void AdaptiveSolver<dim>::Stages::refine(const Refinement &refinement)
{
  refinements.emplace_back(refinement, backend->degrees());
  backend->refine(refinement);
}

// @sect3{Going on where a run has ended}
//
// A run state holds the marks that led to the last mesh, its displacement and its multiplier. The
// meshes are made again from the coarse one, mark by mark: the only way to get the same numbering,
// the same element matrices, and so the same last bit.
/** Marking is not kept in a state, because it follows from the solution. */
template <int dim>
void AdaptiveSolver<dim>::Stages::resume(const RunState<dim> &state)
{
  const FileFormat &format = RunState<dim>::format();
  backend->discretise();
  for (const MeshMarks &marks : state.refinements)
  {
    const Degrees degrees = backend->degrees();
    if (!marks.fits(degrees))
      format.reject(state.name, "the run state has another coarse mesh");
    refine(marks.refinement(degrees));
    backend->discretise(); // element matrices go from step to step, to the last bit
  }
  if (state.history.size() != state.refinements.size() + 1 || !backend->restore(state.values))
    format.reject(state.name, "the run state has another number of steps or unknowns");
  measure(state.history.size() < 2 ? 0. : state.history[state.history.size() - 2].own_stress);
  const Refinement refinement = mark();
  history = state.history;
  std::string limit = end_of_run(refinement);
  if (is_bound_open && limit == "round-off") // what u_N misses of the data may be more
  {
    close_bound();
    limit = end_of_run(refinement);
  }
  if (!limit.empty())
    format.reject(state.name, "there is nothing to go on with after step " +
                                  std::to_string(history.size()) + ": " +
                                  (limit == "round-off" ? "exact to round-off"
                                                        : "Adaptivity/" + limit + " ends the run"));
  refine(refinement);
  backend->times = {};
}

// @sect3{Report}
//
// What a step has to say, as one value. Numbers that double precision does not support any more end
// the run here, with one line, before anybody reads them.
/** What limits and warnings will ask of the step. */
template <int dim>
PastStep<dim> AdaptiveSolver<dim>::Stages::past_step(const EstimateNorms &norms,
                                                     const Energies &energies) const
{
  const auto reduced = backend->reduced();
  PastStep<dim> past;
  past.seconds = history.empty() ? 0. : history.back().seconds; // add_bound() adds its own
  past.estimate = norms.total;
  past.relative_estimate =
      part_of(norms.total / std::sqrt(scene.reference_coercivity()), energies.norm);
  past.lacks_condition = reduced && (!std::isfinite(reduced->condition_raw) ||
                                     !std::isfinite(reduced->condition_scaled));
  return past;
}

template <int dim>
StepReport<dim> AdaptiveSolver<dim>::Stages::report()
{
  const Field<dim> &field = backend->field();
  const EstimateNorms norms = hpvi::norms(estimate, field.communicator());
  check_finite("the error indicator", norms.total);
  Energies energies;
  std::vector<ContactState<dim>> contact;
  std::vector<StressSample<dim>> peaks;
  {
    StageTimer timer(backend->times.recover);
    energies = backend->energies();
    check_numbers(scene, field.largest_displacement(), energies);
    if (const auto reduced = backend->reduced())
      check_algebraic_error(reduced->algebraic);
    contact = contact_states(field);
    peaks = stress_peaks(stress_samples(field), scene);
  }
  history.push_back(past_step(norms, energies));
  history.back().peaks = std::move(peaks);
  const PastStep<dim> &past = history.back();
  StepReport<dim> step{static_cast<unsigned int>(history.size()),
                       scene,
                       field,
                       backend->size(),
                       estimate,
                       norms,
                       {},
                       bound.missing,
                       {},
                       {},
                       backend->reduced(),
                       backend->primal()};
  step.scaled_estimate = norms.total / std::sqrt(scene.reference_coercivity());
  step.relative_estimate = past.relative_estimate;
  step.energies = energies;
  step.contact = std::move(contact);
  step.errors = true_error.measure(field, step.contact);
  step.peaks = past.peaks;
  add_results(step);
  add_bound(step);
  return step;
}

/** What engineers read: forces and probes. */
template <int dim>
void AdaptiveSolver<dim>::Stages::add_results(StepReport<dim> &step)
{
  StageTimer timer(backend->times.recover);
  step.equilibrium = equilibrium(scene, backend->nodal_forces(), backend->communicator);
  step.forces = resultants(scene, step.equilibrium, step.contact);
  step.probes = probe_values(step.field);
  step.probe_lines = probe_lines(step.field);
}

template <int dim>
void AdaptiveSolver<dim>::Stages::add_bound(StepReport<dim> &step)
{
  {
    StageTimer timer(backend->times.recover);
    take_bound(bound, step, history.back());
    const bool is_bounded = step.bound && scene.intervals;
    step.no_intervals =
        is_bounded ? backend->bound_forces(*step.bound, step.forces) : step.no_bound;
    if (is_bounded)
      mean_intervals.set(step);
    history.back().relative_half_width = relative_half_width(step);
  }
  step.times += backend->times;
  history.back().seconds += Utilities::MPI::max(backend->times.total(), backend->communicator);
  backend->times = {};
  step.seconds = history.back().seconds;
  step.peak_memory = Utilities::MPI::sum(peak_memory(), backend->communicator);
}

/** What makes the last step the last of all; else empty. */
template <int dim>
std::string AdaptiveSolver<dim>::Stages::end_of_run(const Refinement &refinement) const
{
  const Field<dim> &field = backend->field();
  const std::string limit = reached_limit(
      scene, history,
      {backend->size().n_free, std::max(field.largest_displacement(), data.displacement),
       backend->missed(bound.bound), [&]() { return backend->round_off_estimate(); },
       is_bound_open});
  return limit.empty() && refinement.is_empty(backend->degrees()) ? nothing_marked(scene.adaptivity)
                                                                  : limit;
}

namespace
{
/** It may have been built by code, or changed since it was read. */
template <int dim>
void check_one_problem(const Scene<dim> &scene)
{
  if (scene.has_load_history())
    throw InputError(scene.origin() + ": Loading/Steps: asks for a history, of which this is one "
                                      "load step only; run it by LoadHistory, or remove it");
  scene.check();
}

template <int dim>
std::unique_ptr<Backend<dim>> checked_backend(const Scene<dim> &scene, MPI_Comm communicator)
{
  together(communicator, [&]() { check_one_problem(scene); });
  return make_backend(scene, communicator);
}
} // namespace

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, MPI_Comm communicator)
    : stages(std::make_unique<Stages>(scene, checked_backend(scene, communicator)))
{
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, AdaptiveSolver &last,
                                    const PastSlip<dim> &past)
{
  check_one_problem(scene);
  stages = std::make_unique<Stages>(scene, last.stages->backend->next_load_step(scene, past));
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, const RunState<dim> &state,
                                    MPI_Comm communicator)
    : AdaptiveSolver(scene, communicator)
{
  const Team team = team_of(stages->scene, communicator); // as in run()
  stages->hear([](const Progress &) {});
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
  Stages &all = *stages;
  if (all.entries.empty())
    all.entries = RunState<dim>::entries_of(all.scene, n_processes(all.backend->communicator));
  return {"the run state",
          all.entries,
          finished ? all.backend->trail() : all.refinements,
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
void AdaptiveSolver<dim>::prepare(const Announce &about_to)
{
  const Team team = team_of(stages->scene, stages->backend->communicator);
  stages->hear(about_to);
  stages->backend->discretise();
}

// @sect3{The loop}
//
// After so much preparation it reads as it is told. The report goes out before refinement, so that whoever listens may write
// files, stop, or change nothing; and a step whose mesh would not change again is the last one.
template <int dim>
void AdaptiveSolver<dim>::run(const std::function<void(const StepReport<dim> &)> &finished_step,
                              const Announce &about_to)
{
  const Team team = team_of(stages->scene, stages->backend->communicator);
  stages->hear(about_to);
  for (bool finished = false; !finished;)
  {
    stages->backend->discretise();
    stages->backend->solve();
    stages->measure(stages->history.empty() ? 0. : stages->history.back().own_stress);
    const Refinement refinement = stages->mark();
    StepReport<dim> step = stages->report();
    step.stopped_by = stages->end_of_run(refinement);
    if (stages->asks_for_bound(step))
    {
      stages->close_bound();
      stages->add_bound(step);
      step.stopped_by = stages->end_of_run(refinement);
    }
    finished = !step.stopped_by.empty();
    if (finished)
      conclude(*stages->backend, stages->history, step);
    take_thickness(step);
    finished_step(step);
    if (!finished)
      stages->refine(refinement);
  }
}

template class AdaptiveSolver<2>;
template class AdaptiveSolver<3>;
} // namespace hpvi
