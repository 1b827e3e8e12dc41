// SPDX-License-Identifier: LGPL-2.1-or-later

// The stages of a step, in the order in which the loop calls them. They see numbers of a step, and ask its backend for those.
#include <hpvi/base/finite.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/driver/claims.h>
#include <hpvi/driver/column_width.h>
#include <hpvi/driver/limits.h>
#include <hpvi/driver/marking.h>
#include <hpvi/driver/step_stages.h>
#include <hpvi/plane/global_cell_indices.h>
#include <hpvi/plane/negligible_solution.h>
#include <hpvi/reader/checks/rejection.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria_base.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
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

/** What stands for it as long as it is not known. */
BoundOfStep open_bound()
{
  BoundOfStep result;
  result.missing = "Error/Bound = last step, and this is none";
  return result;
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
  step.energy_high = bound.energy_high;
  step.bound_imbalance = bound.imbalance;
  if (bound.bound)
  {
    past.relative_bound = part_of(bound.bound->total, step.energies.norm);
    past.hysteresis = bound.bound->hysteresis;
  }
  step.relative_bound = past.relative_bound;
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

// Every stage announces itself before it begins; the library itself prints nothing.
template <int dim>
void StepStages<dim>::set_callback(const std::function<void(const Progress &)> &listener)
{
  on_stage = listener;
  announce(*backend);
}

/** As stages of the step after those of the history. */
template <int dim>
void StepStages<dim>::announce(Backend<dim> &of)
{
  const unsigned int number = history.size() + 1;
  of.on_stage = [this, number](const std::string &stage, const std::string &note) {
    on_stage({number, stage, note});
  };
}

template <int dim>
void StepStages<dim>::solve()
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
void StepStages<dim>::estimate_error()
{
  estimate = backend->estimate();
  norms = hpvi::norms(estimate, backend->communicator);
  check_finite("the error indicator", norms.total,
               scene.materials[0].modulus() * backend->field().largest_displacement());
  {
    StageTimer timer(backend->times.recover);
    energies = backend->energies();
  }
  check_numbers(scene, backend->field().largest_displacement(), energies);
  if (const auto reduced = backend->reduced())
    check_algebraic_error(reduced->algebraic, negligible_energy(scene));
  history.push_back(past_step());
}

/** Of the step before. */
template <int dim>
double StepStages<dim>::hysteresis() const
{
  return history.size() < 2 ? 0. : history[history.size() - 2].hysteresis;
}

template <int dim>
bool StepStages<dim>::has_late_bound() const
{
  return scene.error_bound && scene.error_bound_last && backend->reduced();
}

/** Where it is open: nothing follows, or it may be the end of the run. */
template <int dim>
bool StepStages<dim>::asks_for_bound(const StepReport<dim> &step) const
{
  return is_bound_open && (!step.stopped_by.empty() || may_meet_tolerance(scene, history));
}

template <int dim>
void StepStages<dim>::compute_bound()
{
  is_bound_open = false;
  if (const std::string known = first_contradiction(history, history.size() - 1); !known.empty())
  {
    bound = {};
    bound.missing = no_guarantee(known);
  }
  else
    bound = backend->bound(has_late_bound() ? 0. : hysteresis());
}

template <int dim>
void StepStages<dim>::bound_unless_late()
{
  if (is_bound_open && !has_late_bound())
    compute_bound();
}

// @sect3{Mark}
//
// The strategy sees numbers only: degrees, indicators, and on demand the decay rate of a cell,
// which costs a transformation of its coefficients and is asked for marked cells alone. Some
// things override it, because no indicator can see them.
template <int dim>
Refinement StepStages<dim>::mark() const
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
void StepStages<dim>::refine()
{
  refinements.emplace_back(refinement, backend->degrees());
  if (ahead)
  {
    backend = std::exchange(ahead, nullptr)->take();
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
void StepStages<dim>::resume(const RunState<dim> &state)
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
  is_bound_open = true;
  bound_unless_late();
  refinement = mark();
  std::string limit = end_of_run();
  if (is_bound_open && limit == "round-off") // what u_N misses of the data may be more
  {
    compute_bound();
    limit = end_of_run();
  }
  if (!limit.empty())
    format.reject(state.name, "there is nothing to go on with after step " +
                                  std::to_string(history.size()) + ": " +
                                  (limit == "round-off" ? "exact to round-off"
                                                        : "Adaptivity/" + limit + " ends the run"));
  refine();
  backend->times = {};
}

// @sect3{Report}
//
// What a step has to say, as one value.
/** What limits and warnings will ask of the step. */
template <int dim>
PastStep<dim> StepStages<dim>::past_step() const
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

/** Is there a next step whatever the bound of this one says? It would be solved for nothing else. */
template <int dim>
bool StepStages<dim>::goes_on() const
{
  return end_of_run().empty() && !may_meet_tolerance(scene, history);
}

// The way to the next step needs no bound of this one, unless cells are marked by it. Where there are threads for both, and the
// run goes on for sure, the next step is solved while this one is told: each has parts for one thread, at which the other waited.
template <int dim>
StepReport<dim> StepStages<dim>::decide_and_report()
{
  is_bound_open = true;
  bound = open_bound();
  if (scene.adaptivity.indicator == Indicator::bound)
    bound_unless_late();
  refinement = mark();
  std::optional<StepReport<dim>> step;
  const auto report_all = [&]()
  {
    bound_unless_late();
    step.emplace(report());
  };
  std::unique_ptr<Backend<dim>> next =
      pool_size() > 1 && goes_on() ? backend->ahead(refinement) : nullptr;
  if (next)
  {
    announce(*next);
    ahead = std::make_unique<PipelinedStep<dim>>(std::move(next), *backend, report_all);
  }
  else
    report_all();
  count(*step);
  step->errors = true_error.measure(step->field, step->contact); // which nobody's seconds count
  return std::move(*step);
}

template <int dim>
StepReport<dim> StepStages<dim>::report()
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
  step.extrema = past.extrema;
  add_results(step);
  add_bound(step);
  return step;
}

/** What engineers read: forces and probes. */
template <int dim>
void StepStages<dim>::add_results(StepReport<dim> &step)
{
  StageTimer timer(backend->times.recover);
  step.equilibrium = equilibrium(scene, backend->nodal_forces(), backend->communicator);
  step.forces = resultants(scene, step.equilibrium, step.contact);
  step.probes = probe_values(step.field);
  step.probe_lines = probe_lines(step.field);
}

template <int dim>
void StepStages<dim>::add_bound(StepReport<dim> &step)
{
  StageTimer timer(backend->times.recover);
  take_bound(bound, step, history.back());
  const bool is_bounded = step.bound && scene.intervals;
  step.no_intervals = is_bounded ? backend->bound_forces(*step.bound, step.forces) : step.no_bound;
  if (is_bounded)
    mean_intervals.set(step);
  compare_claims(step);
  history.back().relative_half_width = relative_half_width(step);
}

// What steps guarantee of the exact solution has to agree: a proof, a program or a computer is wrong otherwise. The
// comparison costs nothing, and cannot tell which of two steps is wrong.
template <int dim>
void StepStages<dim>::compare_claims(StepReport<dim> &step)
{
  PastStep<dim> &past = history.back();
  past.claims = claims_of(step, backend->field().largest_displacement());
  Claims earlier;
  for (unsigned int k = 0; k + 1 < history.size(); ++k)
    earlier.insert(earlier.end(), history[k].claims.begin(), history[k].claims.end());
  past.contradiction = contradiction(earlier, past.claims);
  step.contradiction = first_contradiction(history, history.size());
  if (past.contradiction.empty())
    return;
  bound.bound.reset();
  bound.missing = no_guarantee(past.contradiction);
  withdraw_claims(step, bound.missing);
  past.relative_bound = step.relative_bound;
}

/** The rest of the report of a step after which none comes. */
template <int dim>
void StepStages<dim>::conclude(StepReport<dim> &step)
{
  const Adaptivity &limits = step.scene.adaptivity;
  step.largest_displacement = largest_displacement(step.field);
  std::vector<std::vector<StressSample<dim>>> extrema;
  for (const PastStep<dim> &past : history)
    extrema.push_back(past.extrema);
  const std::vector<StressSample<dim>> samples = stress_samples(step.field);
  std::vector<StressSample<dim>> growing = growing_extrema(extrema);
  // The mesh comes from load steps before; on one process, for peaks of others are not known alike on all.
  if (backend->refinement_history().size() >= history.size() &&
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
void StepStages<dim>::count(StepReport<dim> &step)
{
  step.times += backend->times;
  history.back().seconds += Utilities::MPI::max(backend->times.total(), backend->communicator);
  backend->times = {};
  step.seconds = history.back().seconds;
  step.peak_memory = Utilities::MPI::sum(peak_memory(), backend->communicator);
}

/** What makes the last step the last of all; else empty. */
template <int dim>
std::string StepStages<dim>::end_of_run() const
{
  const Field<dim> &field = backend->field();
  const std::string limit = reached_limit(
      scene, history,
      {backend->size().n_free, std::max(field.largest_displacement(), data.displacement),
       backend->missed(bound.bound), [&]() { return backend->round_off_estimate(); }, is_bound_open,
       [&]() { return backend->resolves_data(); }});
  return limit.empty() && refinement.is_empty(backend->degrees()) ? nothing_marked(scene.adaptivity)
                                                                  : limit;
}

// @sect3{The next step beside this one}
//
template <int dim>
PipelinedStep<dim>::PipelinedStep(std::unique_ptr<Backend<dim>> next_step, Backend<dim> &here,
                                  const std::function<void()> &report)
    : next(std::move(next_step))
{
  const auto on_stage = std::exchange(here.on_stage, nullptr);
  const StageTimes before = std::exchange(here.times, {});
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
                          failure = std::current_exception();
                        }
                      });
  }
  const double share = both / (next->times.total() + here.times.total());
  next->times *= share;
  here.times *= share;
  here.times += before;
  here.on_stage = on_stage;
}

template <int dim>
std::unique_ptr<Backend<dim>> PipelinedStep<dim>::take()
{
  if (failure)
    std::rethrow_exception(failure);
  return std::move(next);
}

template class PipelinedStep<2>;
template class PipelinedStep<3>;
template struct StepStages<2>;
template struct StepStages<3>;
} // namespace hpvi
