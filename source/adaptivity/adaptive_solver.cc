// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/adaptivity/adaptive_solver.h>
#include <hpvi/adaptivity/limits.h>
#include <hpvi/adaptivity/marking.h>
#include <hpvi/adaptivity/warnings.h>
#include <hpvi/base/dense_work.h>
#include <hpvi/base/memory.h>
#include <hpvi/contact/multiplier_trace.h>
#include <hpvi/discretisation/iterative_refinement.h>
#include <hpvi/discretisation/reduced_problem.h>

#include <cmath>
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

/** One discrete problem: spaces and system; each member is built from the ones above it. */
template <int dim>
struct Discretisation
{
  const DisplacementSpace<dim> displacement_space;
  const ContactSpace<dim> contact_space;
  std::unique_ptr<const ElasticSystem<dim>> system;

  Discretisation(const Scene<dim> &scene, const Triangulation<dim> &triangulation,
                 const Degrees &degrees, const ShapeTables<dim> &tables)
      : displacement_space(scene, triangulation, degrees, tables),
        contact_space(scene, displacement_space)
  {
  }
};
} // namespace

template <int dim>
struct AdaptiveSolver<dim>::Stages
{
  const Scene<dim> &scene;
  Triangulation<dim> triangulation;
  Degrees degrees;
  const ShapeTables<dim> tables;
  ElementStiffnesses<dim> stiffnesses;
  const LegendreSmoothness<dim> smoothness;
  const TrueError<dim> true_error;
  std::unique_ptr<Discretisation<dim>> discretisation;
  MultiplierTrace<dim> previous; ///< multiplier of the previous step, zero unless it is wanted
  double translation = 0;        ///< likewise
  AlgebraicError algebraic;      ///< of the current step
  StageTimes times;              ///< of the current step
  History history;               ///< of the finished steps
  std::function<void(const Progress &)> about_to;

  explicit Stages(const Scene<dim> &scene)
      : scene(scene), stiffnesses(scene, tables), smoothness(scene.adaptivity.reading),
        true_error(scene, tables)
  {
    prepare_blas();
    make_mesh(scene, triangulation);
    degrees.assign(triangulation.n_active_cells(), scene.adaptivity.start_degree);
  }

  void begin(const std::string &stage, const std::string &note = {}) const;
  std::string dense_note() const;
  void discretise();
  Solution<dim> solve(Reduction &reduction);
  ErrorEstimate estimate(const Solution<dim> &solution);
  Refinement mark(const Solution<dim> &solution, const ErrorEstimate &estimate);
  StepReport<dim> report(const Solution<dim> &solution, const ErrorEstimate &estimate,
                         const Reduction &reduction);
  std::string end_of_run(const Solution<dim> &solution, const Refinement &refinement) const;
  void conclude(StepReport<dim> &step) const;
  void refine(const Refinement &refinement);
};

template <int dim>
void AdaptiveSolver<dim>::Stages::begin(const std::string &stage, const std::string &note) const
{
  about_to({static_cast<unsigned int>(history.size()) + 1, stage, note});
}

/** Of the step whose system is assembled. */
template <int dim>
std::string AdaptiveSolver<dim>::Stages::dense_note() const
{
  return DenseWork{discretisation->system->B.n(), discretisation->system->B.m()}.note();
}

template <int dim>
void AdaptiveSolver<dim>::Stages::discretise()
{
  begin("numbering the unknowns of " + std::to_string(degrees.size()) + " elements");
  std::unique_ptr<Discretisation<dim>> next;
  {
    StageTimer timer(times.setup);
    next = std::make_unique<Discretisation<dim>>(scene, triangulation, degrees, tables);
  }
  begin("assembling " + std::to_string(degrees.size()) + " elements");
  StageTimer timer(times.assemble);
  next->system = std::make_unique<const ElasticSystem<dim>>(
      scene, next->displacement_space, next->contact_space, tables, stiffnesses);
  // Only now may the previous step go: it kept the element matrices that the new one shares.
  discretisation = std::move(next);
}

template <int dim>
Solution<dim> AdaptiveSolver<dim>::Stages::solve(Reduction &reduction)
{
  const ElasticSystem<dim> &system = *discretisation->system;
  const ContactSpace<dim> &contact_space = discretisation->contact_space;
  check_finite("the load vector", std::accumulate(system.f.begin(), system.f.end(), 0.));
  std::unique_ptr<const SchurComplement> schur_complement;
  begin("factorising " + std::to_string(system.A.n()) + " unknowns", dense_note());
  {
    StageTimer timer(times.factor);
    schur_complement = std::make_unique<const SchurComplement>(system.A, system.f,
                                                               system.contact_unknowns, system.B);
  }
  begin(contact_space.n_multipliers() > 0
            ? "finding stick and slip for " + std::to_string(contact_space.n_multipliers()) +
                  " multipliers"
            : "finding the displacement");
  reduction.lambda = previous.values(contact_space, tables);
  reduction.translation = translation;
  const Timer timer;
  Vector<double> u =
      IterativeRefinement<dim>(scene, discretisation->displacement_space, contact_space, tables,
                               system, stiffnesses, *schur_complement)
          .solve(reduction, algebraic);
  times.qp += reduction.seconds;
  times.recover += timer.wall_time() - reduction.seconds;
  if (contact_space.n_multipliers() > 0 && scene.solver.qp_warm_start)
  {
    previous = MultiplierTrace<dim>(contact_space, reduction.lambda);
    translation = reduction.translation;
  }
  return {scene, discretisation->displacement_space, contact_space, std::move(u), reduction.lambda};
}

template <int dim>
ErrorEstimate AdaptiveSolver<dim>::Stages::estimate(const Solution<dim> &solution)
{
  begin("estimating the error of " + std::to_string(degrees.size()) + " elements");
  StageTimer timer(times.estimate);
  ErrorEstimate result = estimate_error(solution, tables);
  check_finite("the error indicator", result.total());
  return result;
}

template <int dim>
Refinement AdaptiveSolver<dim>::Stages::mark(const Solution<dim> &solution,
                                             const ErrorEstimate &estimate)
{
  begin("deciding on h and p");
  StageTimer timer(times.decide);
  Refinement refinement = hpvi::mark(scene.adaptivity, degrees, estimate,
                                     [&](const unsigned int cell)
                                     { return smoothness.decay_rate(solution, tables, cell); });
  if (scene.adaptivity.method != Method::pu)
    for (const UnresolvedJump<dim> &jump : solution.contact_space.unresolved_jumps())
      refinement.bisect[jump.face->cell->active_cell_index()] = true;
  return refinement;
}

template <int dim>
void AdaptiveSolver<dim>::Stages::refine(const Refinement &refinement)
{
  begin("refining");
  StageTimer timer(times.refine);
  degrees = refine_mesh(triangulation, degrees, refinement);
}

template <int dim>
StepReport<dim> AdaptiveSolver<dim>::Stages::report(const Solution<dim> &solution,
                                                    const ErrorEstimate &estimate,
                                                    const Reduction &reduction)
{
  Energies step_energies;
  std::vector<ContactState<dim>> contact;
  {
    StageTimer timer(times.recover);
    step_energies = energies(solution, *discretisation->system, tables, algebraic.energy_product);
    check_numbers(solution, step_energies, algebraic);
    contact = contact_states(solution, tables);
  }
  const double scaled_estimate = estimate.total() / std::sqrt(scene.material.coercivity(dim));
  history.push_back(
      {estimate.total(), ratio(scaled_estimate, step_energies.norm),
       (history.empty() ? 0. : history.back().seconds) + times.total(),
       !std::isfinite(reduction.condition_raw) || !std::isfinite(reduction.condition_scaled)});
  return {static_cast<unsigned int>(history.size()),
          solution,
          estimate,
          scaled_estimate,
          history.back().relative_estimate,
          step_energies,
          contact,
          true_error.measure(solution, contact),
          algebraic,
          reduction.qp,
          reduction.condition_raw,
          reduction.condition_scaled,
          std::exchange(times, {}),
          history.back().seconds,
          {},
          {},
          {}};
}

/** What makes the last step the last of all; else empty. */
template <int dim>
std::string AdaptiveSolver<dim>::Stages::end_of_run(const Solution<dim> &solution,
                                                    const Refinement &refinement) const
{
  const std::string limit = reached_limit(solution, history, tables);
  return limit.empty() && refinement.is_empty(degrees) ? nothing_marked(scene.adaptivity) : limit;
}

/** The rest of the report of a step after which none comes. */
template <int dim>
void AdaptiveSolver<dim>::Stages::conclude(StepReport<dim> &step) const
{
  step.warnings = warnings(step.solution, step.contact, history, step.algebraic);
  if (!dense_note().empty())
    step.warnings.push_back(dense_note());
  step.equilibrium = equilibrium(step.solution, *discretisation->system, tables);
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene)
    : stages(std::make_unique<Stages>(scene))
{
}

template <int dim>
AdaptiveSolver<dim>::~AdaptiveSolver() = default;

template <int dim>
void AdaptiveSolver<dim>::run(const std::function<void(const StepReport<dim> &)> &finished_step,
                              const std::function<void(const Progress &)> &about_to)
{
  stages->about_to = about_to;
  for (bool finished = false; !finished;)
  {
    stages->discretise();
    Reduction reduction;
    const Solution<dim> solution = stages->solve(reduction);
    const ErrorEstimate estimate = stages->estimate(solution);
    const Refinement refinement = stages->mark(solution, estimate);
    StepReport<dim> step = stages->report(solution, estimate, reduction);
    step.stopped_by = stages->end_of_run(solution, refinement);
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
