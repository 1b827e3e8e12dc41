// SPDX-License-Identifier: LGPL-2.1-or-later

// Solve, estimate, mark, refine: this file is the loop, and all other files are what it calls. Each pass is one <i>step</i>: a
// mesh with degrees goes in, a solution with an estimate of its error comes out, and so does the next mesh. Whether a step is
// solved on the contact boundary, by a dense program, or in the whole body, on many processes, is the business of a
// <i>backend</i>; the loop is the same, and so is all that it says of a solution.
#include <hpvi/base/finite.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/driver/claims.h>
#include <hpvi/driver/column_width.h>
#include <hpvi/driver/friction_check.h>
#include <hpvi/driver/limits.h>
#include <hpvi/driver/marking.h>
#include <hpvi/driver/reduced_backend.h>
#include <hpvi/driver/strides.h>
#include <hpvi/driver/thickness.h>
#include <hpvi/driver/threads.h>
#include <hpvi/plane/global_cell_indices.h>
#include <hpvi/plane/negligible_solution.h>
#include <hpvi/plane/pretension_force.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria_base.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** It may have been built by code, or changed since it was read. */
template <int dim>
const Scene<dim> &checked(const Scene<dim> &scene)
{
  if (scene.has_load_history())
    throw InputError(scene.origin() + ": Loading/Steps: asks for a history, of which this is one "
                                      "load step only; run it by LoadHistory, or remove it");
  check(scene);
  return scene;
}

template <int dim>
std::unique_ptr<Backend<dim>> checked_backend(const Scene<dim> &scene, MPI_Comm communicator)
{
  collectively(communicator, [&]() { checked(scene); });
  return make_backend(scene, communicator);
}

/**
 * Scene::error_bound_last: may the bound of the last step of @p history, which is not known yet, say that the
 * tolerance is met? As long as no step has a bound, or a half-width where the tolerance is on one, it may: that of
 * the coarse mesh costs nothing. Then it is taken to fall with the indicator,
 *
 *     bound = indicator * (bound/indicator of the last step that has both),
 *
 * and may be less than that by a third. Never where the tolerance asks for neither.
 */
template <int dim>
bool may_meet_tolerance(const Scene<dim> &scene, const History<dim> &history)
{
  const Adaptivity &limits = scene.adaptivity;
  const bool on_width = !limits.tolerance_column.empty();
  if (limits.tolerance == 0 || !(on_width || limits.tolerance_on == Indicator::bound))
    return false;
  // One bound in vain costs less than a step in vain. Of 1055 runs on a dozen scenes, by all methods and to tolerances
  // from 3e-2 to 6e-6, one in fifty takes a step more than it needs; on average 1.4 bounds stand beside that of the
  // coarse mesh.
  constexpr double margin = 1.5;
  const double estimate = history.back().relative_estimate;
  for (auto past = history.rbegin() + 1; past < history.rend(); ++past)
    if (const double error = on_width ? past->relative_half_width : past->relative_bound;
        std::isfinite(error))
      return estimate * error < margin * limits.tolerance * past->relative_estimate;
  return true;
}

/** @p part over @p whole, which may be zero and has no parts then. */
double part_of(const double part, const double whole)
{
  return part == 0 ? 0. : part / whole;
}

/** Puts @p bound into the report of its step, and what limits ask of it into @p past. */
template <int dim>
void take_bound(const BoundOfStep &bound, StepReport<dim> &step, PastStep<dim> &past)
{
  step.bound = bound.bound;
  step.no_bound = bound.missing;
  step.bound_imbalance = bound.imbalance;
  if (bound.bound)
  {
    past.relative_bound = part_of(bound.bound->total, step.energies.norm);
    past.hysteresis = bound.bound->hysteresis;
  }
  step.relative_bound = past.relative_bound;
  if (const auto &known = bound.bound ? bound.bound : bound.estimate)
    step.equilibrated = {known->estimate, part_of(known->estimate, step.energies.norm),
                         known->coupling, text(known->kind),
                         known->zones,    known->coupling_known};
}

/** eta_K by global_cell_indices(): the same cells are marked on any number of processes. Collective. */
template <int dim>
std::vector<double> of_all_cells(const ErrorEstimate &estimate, const Field<dim> &field)
{
  const Triangulation<dim> &mesh = field.dof_handler.get_triangulation();
  if (!dynamic_cast<const parallel::TriangulationBase<dim> *>(&mesh))
    return estimate.indicators();
  const std::vector<types::global_cell_index> ranks = global_cell_indices(mesh);
  std::vector<std::pair<types::global_cell_index, double>> own;
  for (const auto &cell : field.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      own.emplace_back(ranks[cell->active_cell_index()],
                       estimate.indicator(cell->active_cell_index()));
  std::vector<double> eta(mesh.n_global_active_cells());
  for (const auto &part : Utilities::MPI::all_gather(field.communicator(), own))
    for (const auto &[cell, value] : part)
      eta[cell] = value;
  return eta;
}
} // namespace

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, std::unique_ptr<Backend<dim>> of_path)
    : scene(scene), backend(std::move(of_path)), true_error(scene),
      mean_intervals(scene,
                     [](const Scene<2> &dual, const Solution<2> *mesh_of, const auto &finished_step)
                     {
                       AdaptiveSolver<2>(dual, mesh_of ? std::make_unique<ReducedBackend<2>>(
                                                             checked(dual), *mesh_of)
                                                       : checked_backend(dual, MPI_COMM_SELF))
                           .run(finished_step);
                     })
{
  collectively(backend->communicator, [&]() { data = data_scale(scene); });
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, MPI_Comm communicator)
    : AdaptiveSolver(scene, checked_backend(scene, communicator))
{
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, AdaptiveSolver &last,
                                    const PastSlip<dim> &past)
    : AdaptiveSolver(scene, last.backend->next_load_step(checked(scene), past))
{
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, const RunState<dim> &state,
                                    MPI_Comm communicator)
    : AdaptiveSolver(scene, communicator)
{
  const ThreadPool pool = thread_pool_of(scene, communicator); // as in run()
  set_callback([](const Progress &) {});
  state.require_scene(scene, hpvi::n_processes(communicator));
  // Where a load step has ended nothing is left to mark, and element matrices are the next one's.
  if (!state.loads)
    resume(state);
  else if (!backend->restore_end(state.refinements, state.values))
    RunState<dim>::format().reject(state.name,
                                   "the run state has another coarse mesh or number of unknowns");
}

template <int dim>
RunState<dim> AdaptiveSolver<dim>::state(const std::optional<FinishedLoads> &finished) const
{
  if (entries.empty())
    entries = RunState<dim>::entries_of(scene, n_processes(backend->communicator));
  return {"the run state",
          entries,
          finished ? backend->refinement_history() : refinements,
          backend->values(),
          finished ? History<dim>() : history,
          finished};
}

template <int dim>
std::optional<ReducedPart<dim>> AdaptiveSolver<dim>::reduced() const
{
  return backend->reduced();
}

/** Before anything is reported or written. */
template <int dim>
void AdaptiveSolver<dim>::prepare(const Announce &on_stage)
{
  const ThreadPool pool = thread_pool_of(scene, backend->communicator);
  set_callback(on_stage);
  backend->discretise();
}

// @sect3{The loop}
//
// After so much preparation it reads as it is told. The report goes out before refinement, so that whoever listens may write
// files, stop, or change nothing; and a step whose mesh would not change again is the last one.
template <int dim>
void AdaptiveSolver<dim>::run_steps(
    const std::function<void(const StepReport<dim> &)> &finished_step)
{
  for (bool finished = false; !finished;)
  {
    solve();
    estimate_error();
    StepReport<dim> step = decide_and_report();
    step.stopped_by = {end_of_run()};
    if (!bound && (!step.stopped_by.empty() || may_meet_tolerance(scene, history)))
    {
      bound = bound_of_step();
      add_bound(step);
      count(step);
      step.stopped_by = {end_of_run()};
    }
    finished = !step.stopped_by.empty();
    if (finished)
      conclude(step);
    take_thickness(step);
    finished_step(step);
    if (!finished)
      refine();
  }
}

template <int dim>
void AdaptiveSolver<dim>::run(const std::function<void(const StepReport<dim> &)> &finished_step,
                              const Announce &on_stage)
{
  const ThreadPool pool = thread_pool_of(scene, backend->communicator);
  set_callback(on_stage);
  try
  {
    run_steps(finished_step);
  }
  catch (const MemoryFailure &failure)
  {
    throw MemoryFailure(in_entries_of(scene, failure.what()));
  }
  catch (const NumericalFailure &failure)
  {
    throw NumericalFailure(in_entries_of(scene, failure.what()));
  }
  next.reset();
}

// Every stage announces itself before it begins; the library itself prints nothing.
template <int dim>
void AdaptiveSolver<dim>::set_callback(const std::function<void(const Progress &)> &listener)
{
  on_stage = listener;
  announce(*backend);
}

/** As stages of the step after those of the history. */
template <int dim>
void AdaptiveSolver<dim>::announce(Backend<dim> &of)
{
  const unsigned int number = history.size() + 1;
  of.on_stage = [this, number](const std::string &stage, const std::string &note) {
    on_stage({number, stage, note});
  };
}

template <int dim>
void AdaptiveSolver<dim>::solve()
{
  if (std::exchange(is_solved, false))
    return;
  backend->discretise();
  backend->solve();
}

// @sect3{Estimate}
//
// Two answers to two questions. The residual indicator $\eta_K$ (4.50) says where the error is,
// costs next to nothing and exists for every scene. The guaranteed bound says how large the error
// is at most, and costs half of a step; where the last one alone shall have it, it waits for the limits.
// Numbers that double precision does not support any more end the run here, with one line, before anybody reads them.
template <int dim>
void AdaptiveSolver<dim>::estimate_error()
{
  estimate = backend->estimate();
  norms = hpvi::norms(estimate, backend->communicator);
  check_finite("the error indicator", norms.total,
               scene.materials[0].modulus(dim) * backend->field().largest_displacement());
  {
    StageTimer timer(backend->times.recover);
    energies = backend->energies();
  }
  check_numbers(scene, backend->field().largest_displacement(), energies);
  check_friction_by_pressure(backend->field());
  if (const auto reduced = backend->reduced())
    check_algebraic_error(reduced->algebraic, negligible_energy(scene));
  history.push_back(past_step());
}

template <int dim>
bool AdaptiveSolver<dim>::has_late_bound() const
{
  return scene.error_bound && scene.error_bound_last && (dim == 3 || backend->reduced());
}

/** Asked for the last step, or where it may make this one the last. */
template <int dim>
BoundOfStep AdaptiveSolver<dim>::bound_of_step() const
{
  if (const std::string known = first_contradiction(history, history.size() - 1); !known.empty())
    return {std::nullopt, no_guarantee(known)};
  return backend->bound(
      has_late_bound() || history.size() < 2 ? 0. : history[history.size() - 2].hysteresis);
}

template <int dim>
const BoundOfStep &AdaptiveSolver<dim>::known_bound() const
{
  static const BoundOfStep open{std::nullopt, "Error/Bound = last step, and this is none"};
  return bound ? *bound : open;
}

// @sect3{Mark}
//
// The strategy sees numbers only: degrees, indicators, and on demand the decay rate of a cell,
// which costs a transformation of its coefficients and is asked for marked cells alone. Some
// things override it, because no indicator can see them.
template <int dim>
Refinement AdaptiveSolver<dim>::mark() const
{
  backend->begin("deciding on h and p");
  StageTimer timer(backend->times.decide);
  const auto &known = known_bound().bound ? known_bound().bound : known_bound().estimate;
  const bool by_bound = scene.adaptivity.indicator == Indicator::bound && known;
  const std::vector<double> eta =
      by_bound ? known->indicators() : of_all_cells(estimate, backend->field());
  const auto decay_rate = [&](const unsigned int cell) { return backend->decay_rate(cell); };
  Refinement refinement = hpvi::mark(scene.adaptivity, backend->degrees(), eta, decay_rate);
  if (scene.adaptivity.method != Method::pu)
    backend->mark_unresolved(refinement);
  if constexpr (dim == 2)
    if (scene.adaptivity.method == Method::hpa4)
    {
      const Field<2> &field = backend->field();
      const Degrees degrees = backend->degrees();
      const auto contact = contact_states(field);
      refinement =
          stride({scene, field.dof_handler.get_triangulation(), degrees, eta, decay_rate, contact},
                 part_of_next_step(), refinement,
                 [&](const Triangulation<2> &mesh, const Degrees &of_mesh, Refinement &marks)
                 { backend->keep_bound(mesh, of_mesh, marks); });
    }
  return refinement;
}

/** Of the error, the part that hpa4 aims at. */
template <int dim>
double AdaptiveSolver<dim>::part_of_next_step() const
{
  const Adaptivity &limits = scene.adaptivity;
  const PastStep<dim> &step = history.back();
  double needed = limits.tolerance;
  if (needed > 0)
  {
    double error = step.relative_estimate;
    const bool on_width = !limits.tolerance_column.empty();
    if (on_width || limits.tolerance_on == Indicator::bound)
      for (auto past = history.rbegin() + 1; past < history.rend(); ++past)
        if (const double known = on_width ? past->relative_half_width : past->relative_bound;
            std::isfinite(known))
        {
          error *= known / past->relative_estimate;
          break;
        }
    needed = std::min(1., needed / error);
  }
  return part_of_stride(needed);
}

// @sect3{Refine}
template <int dim>
void AdaptiveSolver<dim>::refine()
{
  refinements.emplace_back(refinement, backend->degrees());
  if (next)
  {
    if (next_failure)
      std::rethrow_exception(next_failure);
    backend = std::move(next);
    is_solved = true;
    return;
  }
  announce(*backend);
  backend->refine(refinement);
}

// @sect3{Going on where a run has ended}
//
// A run state holds the marks that led to the last mesh, its displacement and its multiplier. The
// meshes are made again from the coarse one, mark by mark: the only way to get the same numbering,
// the same element matrices, and so the same last bit.
/** Marking is not kept in a state, because it follows from the solution. */
template <int dim>
void AdaptiveSolver<dim>::resume(const RunState<dim> &state)
{
  const FileFormat &format = RunState<dim>::format();
  backend->discretise();
  for (const MeshMarks &marks : state.refinements)
  {
    const Degrees degrees = backend->degrees();
    if (!marks.fits(degrees))
      format.reject(state.name, "the run state has another coarse mesh");
    refinement = marks.refinement(degrees);
    refine();
    backend->discretise(); // element matrices go from step to step, to the last bit
  }
  if (state.history.size() != state.refinements.size() + 1 || !backend->restore(state.values))
    format.reject(state.name, "the run state has another number of steps or unknowns");
  history = state.history;
  estimate = backend->estimate();
  if (!has_late_bound())
    bound = bound_of_step();
  refinement = mark();
  Stop limit = end_of_run();
  if (!bound && limit == Stop::round_off) // what u_N misses of the data may be more
  {
    bound = bound_of_step();
    limit = end_of_run();
  }
  if (limit != Stop::none)
    format.reject(state.name,
                  "there is nothing to go on with after step " + std::to_string(history.size()) +
                      ": " +
                      (limit == Stop::round_off ? "exact to round-off"
                                                : "Adaptivity/" + text({limit}) + " ends the run"));
  refine();
  backend->times = {};
}

// @sect3{Report}
//
// What a step has to say, as one value.
/** What limits and warnings will ask of the step. */
template <int dim>
PastStep<dim> AdaptiveSolver<dim>::past_step() const
{
  const auto reduced = backend->reduced();
  PastStep<dim> past;
  past.seconds = history.empty() ? 0. : history.back().seconds; // count() adds its own
  past.estimate = norms.total;
  past.relative_estimate =
      part_of(norms.total / std::sqrt(scene.reference_coercivity()), energies.norm);
  past.lacks_condition = reduced && (!std::isfinite(reduced->condition_raw) ||
                                     !std::isfinite(reduced->condition_scaled));
  return past;
}

// The way to the next step needs no bound of this one, unless cells are marked by it. Where there are threads for both, and the
// run goes on for sure, the next step is solved while this one is told: each has parts for one thread, at which the other waited.
template <int dim>
StepReport<dim> AdaptiveSolver<dim>::decide_and_report()
{
  const bool is_late = has_late_bound();
  bound.reset();
  if (!is_late && scene.adaptivity.indicator == Indicator::bound)
    bound = bound_of_step();
  refinement = mark();
  std::optional<StepReport<dim>> step;
  const auto report_all = [&]()
  {
    if (!is_late && !bound)
      bound = bound_of_step();
    step.emplace(report());
  };
  if (pool_size() > 1 && end_of_run() == Stop::none && !may_meet_tolerance(scene, history))
    next = backend->ahead(refinement);
  if (next)
    solve_next_beside(report_all);
  else
    report_all();
  count(*step);
  step->errors = true_error.measure(step->field, step->contact); // which nobody's seconds count
  return std::move(*step);
}

/**
 * It solves on the calling thread, which is the one that hears of stages, beside @p report of this step, whose own stages are
 * silent: the bound needs this mesh and its solution, the next solution neither, so that two threads have work all the time.
 * Seconds of both are shares of the time that they take together.
 */
template <int dim>
void AdaptiveSolver<dim>::solve_next_beside(const std::function<void()> &report)
{
  announce(*next);
  next_failure = nullptr;
  const auto listener = std::exchange(backend->on_stage, nullptr);
  const StageTimes before = std::exchange(backend->times, {});
  double both = 0;
  {
    StageTimer timer(both);
    parallel_for_each(2, 1,
                      [&](const unsigned int part)
                      {
                        if (part == 1)
                          return report();
                        try
                        {
                          next->discretise();
                          next->solve();
                        }
                        catch (...)
                        {
                          next_failure = std::current_exception();
                        }
                      });
  }
  const double share = both / (next->times.total() + backend->times.total());
  next->times *= share;
  backend->times *= share;
  backend->times += before;
  backend->on_stage = listener;
}

template <int dim>
StepReport<dim> AdaptiveSolver<dim>::report()
{
  const Field<dim> &field = backend->field();
  std::vector<ContactState<dim>> contact;
  {
    StageTimer timer(backend->times.recover);
    contact = contact_states(field);
    history.back().extrema = stress_extrema(stress_samples(field), scene);
  }
  const PastStep<dim> &past = history.back();
  StepReport<dim> step{static_cast<unsigned int>(history.size()),
                       backend->scene,
                       field,
                       backend->size(),
                       estimate,
                       norms,
                       {},
                       {},
                       {},
                       {},
                       backend->reduced(),
                       backend->primal()};
  step.scaled_estimate = norms.total / std::sqrt(scene.reference_coercivity());
  step.relative_estimate = past.relative_estimate;
  step.energies = energies;
  step.contact = std::move(contact);
  step.extrema = past.extrema;
  add_results(step);
  step.energy_high = backend->energy_high();
  add_bound(step);
  return step;
}

/** What engineers read: forces and probes. */
template <int dim>
void AdaptiveSolver<dim>::add_results(StepReport<dim> &step)
{
  StageTimer timer(backend->times.recover);
  step.equilibrium = equilibrium(scene, backend->nodal_forces(), backend->communicator);
  step.forces = resultants(scene, step.equilibrium, step.contact);
  if constexpr (dim == 2)
    if (step.reduced && !step.scene.pretensions.empty())
    {
      const std::vector<double> forces = pretension_forces(step.solution());
      for (unsigned int k = 0; k < forces.size(); ++k)
      {
        Resultant<dim> &row = step.forces.emplace_back();
        row.name = step.scene.pretensions[k].name;
        row.kind = ForceKind::pretension;
        row.normal.value = forces[k];
      }
    }
  step.probes = probe_values(step.field);
  step.probe_lines = probe_lines(step.field);
}

template <int dim>
void AdaptiveSolver<dim>::add_bound(StepReport<dim> &step)
{
  StageTimer timer(backend->times.recover);
  take_bound(known_bound(), step, history.back());
  const bool is_history = step.bound && step.bound->kind == BoundKind::history,
             is_bounded = step.bound && scene.intervals && !is_history;
  step.no_intervals = is_bounded   ? backend->bound_forces(*step.bound, step.forces)
                      : is_history ? "slip counts from the load step before"
                                   : step.no_bound;
  if (is_bounded)
    mean_intervals.set(step);
  compare_claims(step);
  history.back().relative_half_width = relative_half_width(step);
}

// What steps guarantee of the exact solution has to agree: a proof, a program or a computer is wrong otherwise. The
// comparison costs nothing, and cannot tell which of two steps is wrong.
template <int dim>
void AdaptiveSolver<dim>::compare_claims(StepReport<dim> &step)
{
  const bool is_tightened =
      !backend->scene.pretensions.empty() && !backend->scene.pretensions.front().is_fixed;
  if (scene.geometry.has_curves() || is_tightened) // each step has a body or a bolt of its own
    return;
  PastStep<dim> &past = history.back();
  past.claims = claims_of(step, backend->field().largest_displacement());
  Claims earlier;
  for (unsigned int k = 0; k + 1 < history.size(); ++k)
    earlier.insert(earlier.end(), history[k].claims.begin(), history[k].claims.end());
  past.contradiction = contradiction(earlier, past.claims);
  step.contradiction = first_contradiction(history, history.size());
  if (past.contradiction.empty())
    return;
  bound = BoundOfStep{std::nullopt, no_guarantee(past.contradiction)};
  withdraw_claims(step, bound->missing);
  past.relative_bound = step.relative_bound;
}

/** The rest of the report of a step after which none comes. */
template <int dim>
void AdaptiveSolver<dim>::conclude(StepReport<dim> &step)
{
  const Adaptivity &limits = step.scene.adaptivity;
  step.largest_displacement = largest_displacement(step.field);
  std::vector<std::vector<StressSample<dim>>> extrema;
  for (const PastStep<dim> &past : history)
    extrema.push_back(past.extrema);
  const std::vector<StressSample<dim>> samples = stress_samples(step.field);
  std::vector<StressSample<dim>> growing = growing_extrema(extrema);
  // The mesh comes from load steps before; on one process, for peaks of others are not known alike on all.
  // So do many layers of a stride in few steps.
  if ((backend->refinement_history().size() >= history.size() ||
       scene.adaptivity.method == Method::hpa4) &&
      n_processes(backend->communicator) == 1)
    for (const StressSample<dim> &peak : extrema_of_rings(step.extrema, samples, step.field))
      if (std::none_of(growing.begin(), growing.end(),
                       [&](const auto &known)
                       { return known.boundary == peak.boundary && known.where == peak.where; }))
        growing.push_back(peak);
  step.unbounded = stress_singularities(growing, samples, step.field);
  const BodyState<dim> body = body_state(step.field);
  Warnings of_all;
  collectively(backend->communicator,
               [&]() { of_all = warnings(step.scene, step.contact, body, history); });
  step.warnings =
      joined(contradiction_warnings(step.contradiction), of_all,
             backend->warnings(step.contact, step.equilibrium),
             tolerance_warnings(limits, history.back().relative_half_width, no_half_width(step)),
             step.bound ? bound_warnings(step.relative_bound, step.bound->imbalance) : Warnings());
  for (Warning &warning : step.warnings)
    warning.text = in_entries_of(step.scene, warning.text);
}

/** Seconds and memory. */
template <int dim>
void AdaptiveSolver<dim>::count(StepReport<dim> &step)
{
  step.times += backend->times;
  history.back().seconds += Utilities::MPI::max(backend->times.total(), backend->communicator);
  backend->times = {};
  step.seconds = history.back().seconds;
  step.peak_memory = Utilities::MPI::sum(peak_memory(), backend->communicator);
}

/** What makes the last step the last of all; else empty. */
template <int dim>
Stop AdaptiveSolver<dim>::end_of_run() const
{
  const Field<dim> &field = backend->field();
  const Stop limit = reached_limit(
      scene, history,
      {backend->size().n_free, std::max(field.largest_displacement(), data.displacement),
       backend->missed(known_bound().bound), [&]() { return backend->round_off_estimate(); },
       !bound, [&]() { return backend->resolves_data(); }});
  return limit == Stop::none && refinement.is_empty(backend->degrees())
             ? nothing_marked(scene.adaptivity)
             : limit;
}

template class AdaptiveSolver<2>;
template class AdaptiveSolver<3>;
} // namespace hpvi
