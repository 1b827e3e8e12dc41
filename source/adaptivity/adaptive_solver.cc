// SPDX-License-Identifier: LGPL-2.1-or-later

// Solve, estimate, mark, refine: this file is the loop, and all other files are what it calls. Each
// pass is one <i>step</i>: a mesh with degrees goes in, a solution with an estimate of its error
// comes out, and so does the next mesh. What steps share is little: the scene, tables of shape
// functions, element matrices that come again, and the multiplier of the step before, from which
// the next one starts.
#include <hpvi/adaptivity/adaptive_solver.h>
#include <hpvi/adaptivity/limits.h>
#include <hpvi/adaptivity/marking.h>
#include <hpvi/adaptivity/warnings.h>
#include <hpvi/base/dense_work.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/one_thread.h>
#include <hpvi/base/text.h>
#include <hpvi/contact/resistance.h>
#include <hpvi/discretisation/iterative_refinement.h>
#include <hpvi/discretisation/reduced_problem.h>
#include <hpvi/evaluation/unseen_contact.h>
#include <hpvi/scene/data_scale.h>
#include <hpvi/stresses/edge_polynomial.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Part of a whole that may be zero, which has no parts. */
double ratio(const double part, const double whole)
{
  return part == 0 ? 0. : part / whole;
}

/** Those that contact sees first; of the others a load that nothing resists is more than round-off. */
template <int dim>
LoadedMotions<dim> loaded_motions(const Discretisation<dim> &discretisation)
{
  const RigidMotions<dim> &free = *discretisation.free_motions;
  const Vector<double> &f = discretisation.system.f;
  const unsigned int n = discretisation.scene.free_motions().size();
  LoadedMotions<dim> result{{}, Vector<double>(n), free.n_seen()};
  for (unsigned int m = 0; m < n; ++m)
  {
    Vector<double> one(n);
    one[m] = 1;
    result.motions.push_back(free.motion(one));
    if (m < free.n_seen())
    {
      result.loads[m] = free.balance().e[m];
      continue;
    }
    const Vector<double> R = free.at_unknowns(one);
    double load = 0, absolute = 0;
    for (unsigned int k = 0; k < R.size(); ++k)
    {
      load += f[k] * R[k];
      absolute += std::abs(f[k] * R[k]);
    }
    if (std::abs(load) > 1e-10 * absolute)
      result.loads[m] = load;
  }
  return result;
}
} // namespace

// @sect3{What the stages share}
//
// The members are in three groups: what stays for the whole run (scene, tables, element matrices,
// closed forms to compare with); what belongs to the current step (mesh, degrees, discretisation);
// and what goes from step to step (the multiplier as a function on the contact boundary, so that it
// can be read on another mesh, and a few numbers of each step). The mesh is a shared pointer to a
// constant: a solution that a user keeps also keeps the mesh it lives on.
template <int dim>
struct AdaptiveSolver<dim>::Stages
{
  const Scene<dim> &scene;
  std::shared_ptr<const Triangulation<dim>> mesh;
  Degrees degrees;
  const std::shared_ptr<const ShapeTables<dim>> tables;
  CondensedElements<dim> elements;
  std::shared_ptr<const LoadRules<dim>> loads;
  const LegendreSmoothness<dim> smoothness;
  const TrueError<dim> true_error;
  ErrorBounds error_bounds;
  std::string no_bound;                        ///< why the current step has none
  double bound_imbalance = 0;                  ///< as StepReport has it
  std::vector<UnresolvedLoad<dim>> unresolved; ///< of the current step, as the next
  std::vector<MissedDisplacement<dim>> missed;
  std::unique_ptr<const Discretisation<dim>> discretisation;
  std::shared_ptr<FactoredSystem> factored;  ///< of it, or of the last load step
  bool is_load_step = false;                 ///< then the factor stays for the next one
  std::unique_ptr<LinearSolver> kept_factor; ///< for a bound that needs it once more
  MultiplierTrace<dim> previous; ///< multiplier of the previous step, zero unless it is wanted
  Vector<double> motion;         ///< likewise, of the free motions of the scene
  AlgebraicError algebraic;      ///< of the current step
  StageTimes times;              ///< of the current step
  History history;               ///< of the finished steps
  std::vector<Refinement> refinements; ///< from the coarse mesh to that of the current step
  std::function<void(const Progress &)> about_to = [](const Progress &) {};

  explicit Stages(const Scene<dim> &scene)
      : Stages(scene, std::make_shared<const ShapeTables<dim>>())
  {
    const auto coarse = std::make_shared<Triangulation<dim>>();
    make_mesh(scene, *coarse);
    degrees.assign(coarse->n_active_cells(), scene.adaptivity.start_degree);
    mesh = coarse;
    loads = std::make_shared<const LoadRules<dim>>(scene, *mesh, tables);
  }

  Stages(const Scene<dim> &scene, const Start &start) : Stages(scene, start.tables)
  {
    mesh = start.mesh;
    degrees = start.degrees;
    loads = std::make_shared<const LoadRules<dim>>(scene, *mesh, tables);
    previous = start.multiplier;
    motion = start.motion;
    factored = start.factored;
    is_load_step = true;
  }

  Stages(const Scene<dim> &scene, std::shared_ptr<const ShapeTables<dim>> all_tables)
      : scene(scene), tables(std::move(all_tables)), elements(scene, *tables),
        smoothness(scene.adaptivity.reading), true_error(scene)
  {
    prepare_blas();
  }

  void begin(const std::string &stage, const std::string &note = {}) const;
  std::string dense_note() const;
  void assemble();
  void discretise();
  void factor();
  Solution<dim> solve(ReducedSolution &reduced);
  bool nothing_acts(const DataScale &scale) const;
  void drop_round_off(Vector<double> &z, Vector<double> &u);
  void keep_start(const Vector<double> &z, const Vector<double> &moved);
  ErrorEstimate estimate(const Solution<dim> &solution);
  std::optional<ErrorBound> bound(const Solution<dim> &solution);
  Refinement mark(const Solution<dim> &solution, const ErrorEstimate &estimate,
                  const std::optional<ErrorBound> &bound);
  StepReport<dim> report(const Solution<dim> &solution, const ErrorEstimate &estimate,
                         const std::optional<ErrorBound> &bound, const ReducedSolution &reduced);
  std::string end_of_run(const Solution<dim> &solution, const std::optional<ErrorBound> &bound,
                         const Refinement &refinement) const;
  void conclude(StepReport<dim> &step) const;
  void refine(const Refinement &refinement);
  void change_mesh(const Refinement &refinement);
  void resume(const RunState &state);
};

// @sect3{Discretise}
//
// Every stage announces itself before it begins, since a run should never be silent for long; the
// library itself prints nothing.
template <int dim>
void AdaptiveSolver<dim>::Stages::begin(const std::string &stage, const std::string &note) const
{
  about_to({static_cast<unsigned int>(history.size()) + 1, stage, note});
}

/** Of the step whose system is assembled. */
template <int dim>
std::string AdaptiveSolver<dim>::Stages::dense_note() const
{
  return DenseWork{discretisation->contact_rows.kept.size(), discretisation->contact_rows.n_rows()}
      .note();
}

// Two objects make a step: the spaces, without any integral, and the discretisation, which has
// assembled $A$ and $f$. The old discretisation dies only when the new one stands, for they share
// element matrices: away from the refined cells most cells are congruent to cells that were there
// before.
template <int dim>
void AdaptiveSolver<dim>::Stages::assemble()
{
  if (discretisation && &discretisation->spaces->displacement_space.triangulation() == mesh.get())
    return; // prepare() has been here
  begin("numbering the unknowns of " + std::to_string(degrees.size()) + " elements");
  std::shared_ptr<const Spaces<dim>> spaces;
  {
    StageTimer timer(times.setup);
    spaces = std::make_shared<const Spaces<dim>>(scene, mesh, degrees, tables, loads);
  }
  begin("assembling " + std::to_string(degrees.size()) + " elements");
  StageTimer timer(times.assemble);
  unresolved = loads->unresolved(*mesh);
  missed = loads->missed_displacements(*mesh, degrees);
  // The previous one goes last: it keeps the element matrices that the new one shares.
  discretisation = std::make_unique<const Discretisation<dim>>(scene, spaces, elements);
}

// Where contact alone holds the body, statics has a say before anything is factored. Loads whose
// resultant lies outside the foundation end the run. A resultant inside may still pass between the
// last point of the multiplier and the end of the contact, where this mesh cannot press: cells are
// bisected there until it can. The same mesh always leads to the same bisections, so that a run state
// need not keep them.
template <int dim>
void AdaptiveSolver<dim>::Stages::discretise()
{
  assemble();
  if (!discretisation->free_motions)
    return;
  require_equilibrium(discretisation->spaces->contact_space, loaded_motions(*discretisation));
  for (unsigned int levels_left = 8;; --levels_left)
  {
    const std::optional<MissingContact> missing =
        missing_contact(discretisation->spaces->contact_space, loaded_motions(*discretisation));
    if (!missing)
      return;
    if (levels_left == 0 || missing->cells.empty())
      throw NumericalFailure(missing->why);
    Refinement refinement{std::vector<bool>(degrees.size()), degrees};
    for (const unsigned int cell : missing->cells)
      refinement.bisect[cell] = true;
    change_mesh(refinement);
    assemble();
  }
}

// @sect3{Solve}
//
// The sparse factorisation reduces the elastic body to its contact boundary, equations (5.6) and
// (5.7). What remains is a quadratic program for friction and pressure, or Coulomb's cones, whose
// solution gives the displacement back. The starting value is the multiplier of the step before:
// stick and slip change little from mesh to mesh, and most programs then end after a few
// factorisations. <code>IterativeRefinement</code> wraps the whole, because on deep meshes the
// round-off of one solution is larger than the discretisation error of a well-resolved field.
//
// The load steps of a history that share a mesh share <code>factored</code>: prescribed values and loads
// are in the right-hand side alone.
template <int dim>
void AdaptiveSolver<dim>::Stages::factor()
{
  const ElasticSystem<dim> &system = discretisation->system;
  const ConditionRows &rows = discretisation->contact_rows;
  if (factored && factored->is_of(system.A, discretisation->stabilisation(), rows))
  {
    factored->reduction.set_load(system.f, rows.prescribed);
    return;
  }
  begin("factorising " + std::to_string(system.A.n()) + " unknowns", dense_note());
  factored.reset(); // there may not be room for two
  factored = std::make_shared<FactoredSystem>(discretisation->factor(), system.f, rows);
}

template <int dim>
Solution<dim> AdaptiveSolver<dim>::Stages::solve(ReducedSolution &reduced)
{
  const ElasticSystem<dim> &system = discretisation->system;
  const ContactSpace<dim> &contact_space = discretisation->spaces->contact_space;
  check_finite("the load vector", std::accumulate(system.f.begin(), system.f.end(), 0.));
  {
    StageTimer timer(times.factor);
    factor();
  }
  begin(contact_space.n_multipliers() > 0
            ? "finding stick and slip for " + std::to_string(contact_space.n_multipliers()) +
                  " multipliers"
            : "finding the displacement");
  reduced.z = previous.values(contact_space, *tables);
  if (system.f.all_zero()) // the start would set the tolerance of a solution that may be zero
    reduced.z = 0.;
  const auto &motions = discretisation->free_motions;
  if (motions)
    reduced.motion = motions->from_basis(motion);
  const Timer timer;
  Vector<double> u =
      IterativeRefinement<dim>(*discretisation, elements, factored->solver, factored->reduction)
          .solve(reduced, algebraic);
  times.qp += reduced.seconds;
  times.recover += timer.wall_time() - reduced.seconds;
  drop_round_off(reduced.z, u);
  keep_start(reduced.z, motions ? motions->in_basis(reduced.motion) : Vector<double>());
  if (scene.error_bound && scene.no_error_bound().empty() &&
      (scene.is_nearly_incompressible() ||
       std::any_of(contact_space.faces().begin(), contact_space.faces().end(),
                   [](const auto &face) { return varies(face.friction); })))
    kept_factor = std::make_unique<LinearSolver>(std::move(factored->solver));
  if (kept_factor || !is_load_step)
    factored.reset();
  return {scene, discretisation->spaces, std::move(u), reduced.z};
}

/** No load, no prescribed displacement, no past slip, no overlap: then u = 0 and z = 0 solve the discrete problem. */
template <int dim>
bool AdaptiveSolver<dim>::Stages::nothing_acts(const DataScale &scale) const
{
  const auto &multipliers = discretisation->spaces->contact_space.multipliers();
  return scale.displacement == 0 && discretisation->system.f.all_zero() &&
         std::none_of(multipliers.begin(), multipliers.end(),
                      [](const ContactMultiplier<dim> &multiplier)
                      {
                        return multiplier.kind == ContactMultiplier<dim>::Kind::friction
                                   ? multiplier.gap != 0
                                   : multiplier.gap < 0;
                      });
}

/** What is round-off beside the data of the scene and its history is zero: friction and pressure, then u. */
template <int dim>
void AdaptiveSolver<dim>::Stages::drop_round_off(Vector<double> &z, Vector<double> &u)
{
  const DataScale scale = data_scale(scene);
  const bool is_zero = nothing_acts(scale);
  if (!is_zero && z.size() > 0 && z.linfty_norm() > round_off_of_data * scale.stress)
    return;
  z = 0.;
  if (!is_zero && u.linfty_norm() > round_off_of_data * scale.displacement)
    return;
  u = 0.;
  algebraic = {};
}

/** The next step begins where this one ends. */
template <int dim>
void AdaptiveSolver<dim>::Stages::keep_start(const Vector<double> &z, const Vector<double> &moved)
{
  const ContactSpace<dim> &contact_space = discretisation->spaces->contact_space;
  if (contact_space.n_multipliers() == 0 || !scene.solver.qp_warm_start)
    return;
  previous = MultiplierTrace<dim>(contact_space, z);
  motion = moved;
}

// @sect3{Estimate}
//
// Two answers to two questions. The residual indicator $\eta_K$ (4.50) says where the error is,
// costs next to nothing and exists for every scene. The guaranteed bound says how large the error
// is at most. Where there is no bound its reason is kept, since "none" without a reason is no
// answer.
template <int dim>
ErrorEstimate AdaptiveSolver<dim>::Stages::estimate(const Solution<dim> &solution)
{
  begin("estimating the error of " + std::to_string(degrees.size()) + " elements");
  StageTimer timer(times.estimate);
  ErrorEstimate result = estimate_error(solution);
  check_finite("the error indicator", result.total());
  return result;
}

template <int dim>
std::optional<ErrorBound> AdaptiveSolver<dim>::Stages::bound(const Solution<dim> &solution)
{
  no_bound = scene.error_bound ? scene.no_error_bound() : "Error/Bound = false";
  bound_imbalance = std::numeric_limits<double>::quiet_NaN();
  if (no_bound.empty() && !unresolved.empty())
  {
    const UnresolvedLoad<dim> &worst =
        *std::max_element(unresolved.begin(), unresolved.end(),
                          [](const auto &a, const auto &b) { return a.deviation < b.deviation; });
    no_bound = lower_case(worst.name.substr(0, 1)) + worst.name.substr(1) +
               " is not resolved near " + to_string(worst.where) + ", by " +
               text(worst.deviation / loads->sum().absolute, 2) + " of all loads";
  }
  if (!no_bound.empty())
    return {};
  begin("bounding the error of " + std::to_string(degrees.size()) + " elements");
  StageTimer timer(times.bound);
  const ErrorBound result = error_bounds.compute(solution, *discretisation, std::move(kept_factor),
                                                 history.empty() ? 0. : history.back().own_stress);
  no_bound = std::isfinite(result.total) ? result.flaw : "it is not finite";
  bound_imbalance = result.imbalance;
  return no_bound.empty() ? std::optional<ErrorBound>(result) : std::nullopt;
}

// @sect3{Mark}
//
// The strategy sees numbers only: degrees, indicators, and on demand the decay rate of a cell,
// which costs a transformation of its coefficients and is asked for marked cells alone. Some
// things override it, because no indicator can see them: a jump of the friction bound or the
// coefficient inside an edge, contact that the points of the multiplier have missed, a gap, a bound
// or a coefficient that varies between these points, loads that no quadrature resolves and
// displacements that nodes miss. Their cells are bisected until it is resolved.
template <int dim>
Refinement AdaptiveSolver<dim>::Stages::mark(const Solution<dim> &solution,
                                             const ErrorEstimate &estimate,
                                             const std::optional<ErrorBound> &bound)
{
  begin("deciding on h and p");
  StageTimer timer(times.decide);
  Refinement refinement =
      hpvi::mark(scene.adaptivity, degrees,
                 scene.adaptivity.indicator == Indicator::bound && bound ? bound->indicators()
                                                                         : estimate.indicators(),
                 [&](const unsigned int cell) { return smoothness.decay_rate(solution, cell); });
  if (scene.adaptivity.method != Method::pu)
  {
    for (const UnresolvedJump<dim> &jump : solution.contact_space.unresolved_jumps(solution.z))
      refinement.bisect[jump.face->cell->active_cell_index()] = true;
    for (const UnseenContact<dim> &contact : unseen_contacts(solution))
      refinement.bisect[contact.face->cell->active_cell_index()] = true;
    for (const UnseenGap<dim> &gap : unseen_gaps(solution))
      refinement.bisect[gap.face->cell->active_cell_index()] = true;
    for (const UnresolvedBound<dim> &bound : solution.contact_space.unresolved_bounds(solution.z))
      refinement.bisect[bound.face->cell->active_cell_index()] = true;
    for (const UnresolvedLoad<dim> &load : unresolved)
      refinement.bisect[load.cell] = true;
    for (const MissedDisplacement<dim> &displacement : missed)
      refinement.bisect[displacement.cell] = true;
  }
  return refinement;
}

// @sect3{Refine}
//
// The mesh is copied, and the copy refined. That costs less than a hundredth of a step, and leaves
// every solution its own mesh.
template <int dim>
void AdaptiveSolver<dim>::Stages::refine(const Refinement &refinement)
{
  change_mesh(refinement);
  refinements.push_back(refinement);
}

template <int dim>
void AdaptiveSolver<dim>::Stages::change_mesh(const Refinement &refinement)
{
  begin("refining");
  StageTimer timer(times.refine);
  // Solutions keep the mesh that they live on.
  const auto refined = std::make_shared<Triangulation<dim>>();
  refined->copy_triangulation(*mesh);
  degrees = refine_mesh(*refined, degrees, refinement);
  mesh = refined;
}

// @sect3{Going on where a run has ended}
//
// A run state holds the marks that led to the last mesh, its displacement and its multiplier. The
// meshes are made again from the coarse one, mark by mark: the only way to get the same numbering,
// the same element matrices, and so the same last bit.
/** Marking is not kept in a state, because it follows from the solution. */
template <int dim>
void AdaptiveSolver<dim>::Stages::resume(const RunState &state)
{
  const FileFormat &format = RunState::format();
  format.check_entries(state.name, state.entries,
                       RunState::entries_of(scene.effective_parameters()));
  discretise();
  for (const Refinement &refinement : state.refinements)
  {
    if (refinement.bisect.size() != degrees.size())
      format.reject(state.name, "the run state has another coarse mesh");
    refine(refinement);
    discretise(); // element matrices go from step to step, to the last bit
  }
  const auto &spaces = discretisation->spaces;
  if (state.history.size() != state.refinements.size() + 1 ||
      state.u.size() != spaces->displacement_space.n_dofs() ||
      state.z.size() != spaces->contact_space.n_multipliers() ||
      !(state.motion.size() == 0 || state.motion.size() == scene.free_motions().size()))
    format.reject(state.name, "the run state has another number of steps or unknowns");
  const Solution<dim> solution(scene, spaces, state.u, state.z);
  history.assign(state.history.begin(), state.history.end() - 1); // as the last step found it
  keep_start(solution.z, state.motion);
  const std::optional<ErrorBound> last_bound = bound(solution);
  const Refinement refinement = mark(solution, estimate(solution), last_bound);
  history = state.history;
  const std::string limit = end_of_run(solution, last_bound, refinement);
  if (!limit.empty())
    format.reject(state.name, "there is nothing to go on with after step " +
                                  std::to_string(history.size()) + ": " +
                                  (limit == "round-off" ? "exact to round-off"
                                                        : "Adaptivity/" + limit + " ends the run"));
  refine(refinement);
  times = {};
}

// @sect3{Report}
//
// What a step has to say, as one value. Numbers that double precision does not support any more end
// the run here, with one line, before anybody reads them.
template <int dim>
StepReport<dim> AdaptiveSolver<dim>::Stages::report(const Solution<dim> &solution,
                                                    const ErrorEstimate &estimate,
                                                    const std::optional<ErrorBound> &bound,
                                                    const ReducedSolution &reduced)
{
  Energies step_energies;
  std::vector<ContactState<dim>> contact;
  std::vector<StressSample<dim>> peaks;
  {
    StageTimer timer(times.recover);
    step_energies = energies(solution, discretisation->system, algebraic.energy_product);
    check_numbers(solution, step_energies, algebraic);
    contact = contact_states(solution);
    peaks = stress_peaks(stress_samples(solution), scene);
  }
  const double scaled_estimate = estimate.total() / std::sqrt(scene.coercivity());
  history.push_back(
      {estimate.total(), ratio(scaled_estimate, step_energies.norm),
       bound ? ratio(bound->total, step_energies.norm) : std::numeric_limits<double>::quiet_NaN(),
       (history.empty() ? 0. : history.back().seconds) + times.total(),
       !std::isfinite(reduced.condition_raw) || !std::isfinite(reduced.condition_scaled),
       bound ? bound->own_stress : 0., peaks});
  return {static_cast<unsigned int>(history.size()),
          solution,
          discretisation->system,
          estimate,
          scaled_estimate,
          history.back().relative_estimate,
          bound,
          no_bound,
          bound_imbalance,
          history.back().relative_bound,
          step_energies,
          contact,
          true_error.measure(solution, contact),
          algebraic,
          reduced.qp,
          reduced.coulomb,
          reduced.condition_raw,
          reduced.condition_scaled,
          std::exchange(times, {}),
          history.back().seconds,
          {},
          {},
          {},
          {},
          peaks};
}

/** What makes the last step the last of all; else empty. */
template <int dim>
std::string AdaptiveSolver<dim>::Stages::end_of_run(const Solution<dim> &solution,
                                                    const std::optional<ErrorBound> &bound,
                                                    const Refinement &refinement) const
{
  const bool sees_data = unresolved.empty() && missed.empty();
  const std::string limit = reached_limit(solution, history,
                                          !sees_data ? std::numeric_limits<double>::infinity()
                                          : bound    ? bound->oscillation
                                                     : 0.);
  return limit.empty() && refinement.is_empty(degrees) ? nothing_marked(scene.adaptivity) : limit;
}

/** The rest of the report of a step after which none comes. */
template <int dim>
void AdaptiveSolver<dim>::Stages::conclude(StepReport<dim> &step) const
{
  step.warnings = warnings(step.solution, step.contact, history, step.algebraic);
  if (scene.adaptivity.tolerance > 0 && scene.adaptivity.tolerance_on == Indicator::bound &&
      !no_bound.empty())
    step.warnings.push_back("Adaptivity/Tolerance was compared with the residual indicator, which "
                            "guarantees nothing: there is no bound of the error, because " +
                            no_bound);
  for (const std::string &line :
       {several_solutions(step.coulomb), dense_note(),
        step.bound ? round_off_of_bound(step.relative_bound, step.bound->imbalance) : ""})
    if (!line.empty())
      step.warnings.push_back(line);
  step.equilibrium = equilibrium(step.solution, discretisation->system);
  std::vector<std::vector<StressSample<dim>>> peaks;
  for (const PastStep &past : history)
    peaks.push_back(past.peaks);
  step.unbounded =
      unbounded_stresses(growing_peaks(peaks), stress_samples(step.solution), step.solution);
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
} // namespace

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene)
{
  check_one_problem(scene);
  stages = std::make_unique<Stages>(scene);
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, const Start &start)
{
  check_one_problem(scene);
  stages = std::make_unique<Stages>(scene, start);
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene, const RunState &state)
    : AdaptiveSolver(scene)
{
  const OneThread one_thread; // as in run(): other numbers of threads round otherwise
  stages->resume(state);
}

template <int dim>
AdaptiveSolver<dim>::~AdaptiveSolver() = default;

template <int dim>
typename AdaptiveSolver<dim>::Start AdaptiveSolver<dim>::end() const
{
  const auto &discretisation = *stages->discretisation;
  if (stages->factored)
    stages->factored->remember(discretisation.system.A, discretisation.stabilisation(),
                               discretisation.contact_rows);
  return {stages->mesh,   stages->degrees, stages->previous,
          stages->motion, stages->tables,  stages->factored};
}

template <int dim>
RunState AdaptiveSolver<dim>::state(const StepReport<dim> &step) const
{
  return {"the run state",     RunState::entries_of(stages->scene.effective_parameters()),
          stages->refinements, step.solution.u,
          step.solution.z,     stages->motion,
          stages->history};
}

/** Before anything is reported or written. */
template <int dim>
void AdaptiveSolver<dim>::prepare(const std::function<void(const Progress &)> &about_to)
{
  const OneThread one_thread;
  stages->about_to = about_to;
  stages->discretise();
}

// @sect3{The loop}
//
// After so much preparation it reads as it is told. The report goes out before refinement, so that
// whoever listens may write files, stop, or change nothing; and a step whose mesh would not change
// again is the last one.
template <int dim>
void AdaptiveSolver<dim>::run(const std::function<void(const StepReport<dim> &)> &finished_step,
                              const std::function<void(const Progress &)> &about_to)
{
  const OneThread one_thread;
  stages->about_to = about_to;
  for (bool finished = false; !finished;)
  {
    stages->discretise();
    ReducedSolution reduced;
    const Solution<dim> solution = stages->solve(reduced);
    const ErrorEstimate estimate = stages->estimate(solution);
    const std::optional<ErrorBound> bound = stages->bound(solution);
    const Refinement refinement = stages->mark(solution, estimate, bound);
    StepReport<dim> step = stages->report(solution, estimate, bound, reduced);
    step.stopped_by = stages->end_of_run(solution, bound, refinement);
    finished = !step.stopped_by.empty();
    if (finished)
      stages->conclude(step);
    finished_step(step);
    if (!finished)
      stages->refine(refinement);
  }
}

template class AdaptiveSolver<2>;
} // namespace hpvi
