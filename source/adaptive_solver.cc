// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/timer.h>
#include <hpvi/adaptive_solver.h>
#include <hpvi/multiplier_trace.h>
#include <hpvi/reduced_problem.h>
#include <hpvi/refinement_strategy.h>
#include <hpvi/warnings.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Adds the wall time of its own life to a stage. */
class StageTimer
{
public:
  explicit StageTimer(double &seconds) : seconds(seconds)
  {
  }
  ~StageTimer()
  {
    seconds += timer.wall_time();
  }

private:
  Timer timer;
  double &seconds;
};

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
  StageTimes times;              ///< of the current step
  double seconds = 0;
  unsigned int number = 0;

  explicit Stages(const Scene<dim> &scene)
      : scene(scene), stiffnesses(scene, tables), smoothness(scene.adaptivity.reading),
        true_error(scene, tables)
  {
    make_mesh(scene, triangulation);
    degrees.assign(triangulation.n_active_cells(), scene.adaptivity.start_degree);
  }

  void discretise();
  Solution<dim> solve(Reduction &reduction);
  ErrorEstimate estimate(const Solution<dim> &solution);
  Refinement decide(const Solution<dim> &solution, const ErrorEstimate &estimate);
  Step<dim> report(const Solution<dim> &solution, const ErrorEstimate &estimate,
                   const Reduction &reduction);
  void refine(const Refinement &refinement);
};

template <int dim>
void AdaptiveSolver<dim>::Stages::discretise()
{
  std::unique_ptr<Discretisation<dim>> next;
  {
    StageTimer timer(times.setup);
    next = std::make_unique<Discretisation<dim>>(scene, triangulation, degrees, tables);
  }
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
  std::unique_ptr<const SchurComplement> schur_complement;
  {
    StageTimer timer(times.factor);
    schur_complement = std::make_unique<const SchurComplement>(system.A, system.f,
                                                               system.contact_unknowns, system.B);
  }
  if (contact_space.n_multipliers() > 0)
  {
    StageTimer timer(times.qp);
    reduction.lambda = previous.values(contact_space, tables);
    reduction.translation = translation;
    reduction = solve_reduced_problem(scene, contact_space, system, *schur_complement,
                                      std::move(reduction));
    if (scene.solver.qp_warm_start)
    {
      previous = MultiplierTrace<dim>(contact_space, reduction.lambda);
      translation = reduction.translation;
    }
  }

  StageTimer timer(times.recover);
  Vector<double> x = schur_complement->displacement(reduction.lambda);
  if (scene.free_translation)
    x.add(reduction.translation, system.translation);
  return {scene, discretisation->displacement_space, contact_space, system.recover(x),
          reduction.lambda};
}

template <int dim>
ErrorEstimate AdaptiveSolver<dim>::Stages::estimate(const Solution<dim> &solution)
{
  StageTimer timer(times.estimate);
  return estimate_error(solution, tables);
}

template <int dim>
Refinement AdaptiveSolver<dim>::Stages::decide(const Solution<dim> &solution,
                                               const ErrorEstimate &estimate)
{
  StageTimer timer(times.decide);
  Refinement refinement =
      mark(scene.adaptivity, degrees, estimate,
           [&](const unsigned int cell) { return smoothness.decay_rate(solution, tables, cell); });
  if (scene.adaptivity.method != Method::pu)
    for (const UnresolvedJump<dim> &jump : solution.contact_space.unresolved_jumps())
      refinement.bisect[jump.face->cell->active_cell_index()] = true;
  return refinement;
}

template <int dim>
void AdaptiveSolver<dim>::Stages::refine(const Refinement &refinement)
{
  StageTimer timer(times.refine);
  degrees = refine_mesh(triangulation, degrees, refinement);
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene)
    : stages(std::make_unique<Stages>(scene))
{
}

template <int dim>
AdaptiveSolver<dim>::~AdaptiveSolver() = default;

template <int dim>
Step<dim> AdaptiveSolver<dim>::Stages::report(const Solution<dim> &solution,
                                              const ErrorEstimate &estimate,
                                              const Reduction &reduction)
{
  Energies step_energies;
  {
    StageTimer timer(times.recover);
    step_energies = energies(solution, *discretisation->system, tables);
  }
  const double scaled_estimate = estimate.total() / std::sqrt(2 * scene.material.mu());
  seconds += times.total();
  return {++number,
          solution,
          estimate,
          scaled_estimate,
          scaled_estimate / step_energies.norm,
          step_energies,
          true_error.measure(solution),
          reduction.qp,
          reduction.condition_raw,
          reduction.condition_scaled,
          times,
          seconds,
          {},
          {}};
}

namespace
{
/** Which limit of the scene does this step reach? Empty: none. */
template <int dim>
std::string reached_limit(const Adaptivity &limits, const Step<dim> &step)
{
  if (step.relative_estimate < limits.tolerance)
    return "Tolerance";
  if (step.number >= limits.maximum_steps)
    return "Maximum steps";
  if (step.solution.displacement_space.n_free_dofs() >= limits.maximum_unknowns)
    return "Maximum unknowns";
  if (limits.maximum_seconds > 0 && step.seconds >= limits.maximum_seconds)
    return "Maximum seconds";
  return {};
}
} // namespace

template <int dim>
void AdaptiveSolver<dim>::run(const std::function<void(const Step<dim> &)> &finished_step)
{
  std::vector<double> estimates;
  for (bool finished = false; !finished;)
  {
    stages->discretise();
    Reduction reduction;
    const Solution<dim> solution = stages->solve(reduction);
    const ErrorEstimate estimate = stages->estimate(solution);
    const Refinement refinement = stages->decide(solution, estimate);
    Step<dim> step = stages->report(solution, estimate, reduction);
    step.stopped_by = reached_limit(stages->scene.adaptivity, step);
    if (step.stopped_by.empty() && refinement.is_empty(stages->degrees))
      step.stopped_by = "Maximum degree";
    estimates.push_back(estimate.total());
    finished = !step.stopped_by.empty();
    if (finished)
      step.warnings = warnings(solution, stages->tables, estimates);
    finished_step(step);
    stages->times = StageTimes();
    if (!finished)
      stages->refine(refinement);
  }
}

template class AdaptiveSolver<2>;
} // namespace hpvi
