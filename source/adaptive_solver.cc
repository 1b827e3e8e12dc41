// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/timer.h>
#include <hpvi/adaptive_solver.h>
#include <hpvi/augmented_lagrangian.h>
#include <hpvi/refinement_strategy.h>
#include <hpvi/schur_complement.h>
#include <hpvi/warnings.h>

#include <sstream>

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

/** What the solution of the reduced problem brings besides the multiplier. */
struct Reduction
{
  Vector<double> lambda;
  double translation = 0; ///< length by which a body moves that friction alone holds
  QpReport qp;
  double condition_raw = 0, condition_scaled = 0;
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
  StageTimes times; ///< of the current step
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
  void solve_for_multiplier(const SchurComplement &schur_complement, Reduction &reduction);
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
  std::unique_ptr<const SchurComplement> schur_complement;
  {
    StageTimer timer(times.factor);
    schur_complement = std::make_unique<const SchurComplement>(system.A, system.f,
                                                               system.contact_unknowns, system.B);
  }
  if (discretisation->contact_space.n_multipliers() > 0)
    solve_for_multiplier(*schur_complement, reduction);

  StageTimer timer(times.recover);
  Vector<double> x = schur_complement->displacement(reduction.lambda);
  if (scene.free_translation)
    x.add(reduction.translation, system.translation);
  return {scene, discretisation->displacement_space, discretisation->contact_space,
          system.recover(x), reduction.lambda};
}

namespace
{
std::string not_converged(const QpReport &report, const unsigned int size, const double tolerance)
{
  std::ostringstream line;
  line << "the quadratic program for the multiplier (" << size << " unknowns) has not converged "
       << "after " << report.multiplications << " products with S: relative projected gradient "
       << report.projected_gradient << ", tolerance " << tolerance
       << "; raise Solver/QP maximum multiplications or Solver/QP tolerance";
  return line.str();
}
} // namespace

namespace
{
/** The balance of forces along the free translation, `R'(f - B' lambda) = 0`. */
template <int dim>
EqualityConstraint balance_of_forces(const ElasticSystem<dim> &system)
{
  EqualityConstraint result{Vector<double>(system.B.m()), system.translation * system.f};
  for (unsigned int m = 0; m < system.B.m(); ++m)
    for (unsigned int k = 0; k < system.B.n(); ++k)
      result.G[m] += system.B(m, k) * system.translation[system.contact_unknowns[k]];
  return result;
}

/** Friction can carry |G|_1 at most: where the loads ask for more there is no equilibrium. */
template <int dim>
void check_equilibrium(const Scene<dim> &scene, const EqualityConstraint &balance)
{
  const double applied = std::abs(balance.e), available = balance.G.l1_norm();
  if (applied <= available * (1 + 1e-10))
    return;
  std::ostringstream line;
  line << "no equilibrium: the loads push the body along (" << *scene.free_translation << ") with "
       << applied << ", friction can resist with " << available
       << " at most; add a support, raise Friction bound or lower the loads";
  throw NumericalFailure(line.str());
}
} // namespace

template <int dim>
void AdaptiveSolver<dim>::Stages::solve_for_multiplier(const SchurComplement &schur_complement,
                                                       Reduction &reduction)
{
  StageTimer timer(times.qp);
  QuadraticProgram qp{schur_complement.S(), schur_complement.d(),
                      discretisation->contact_space.feasible_set()};
  qp.d += discretisation->system->B_prescribed;

  Mprgp::Settings settings;
  settings.tolerance = scene.solver.qp_tolerance;
  settings.maximum_multiplications = scene.solver.qp_maximum_multiplications;
  settings.diagonal_scaling = scene.solver.diagonal_scaling;
  reduction.lambda.reinit(qp.d.size());
  const Mprgp mprgp(settings);
  if (scene.free_translation)
  {
    const EqualityConstraint balance = balance_of_forces(*discretisation->system);
    check_equilibrium(scene, balance);
    // The inner problems leave noise of their own tolerance in the balance.
    reduction.qp =
        AugmentedLagrangian(mprgp, 1 / discretisation->system->spring, 100 * settings.tolerance)
            .solve(qp, balance, reduction.lambda, reduction.translation);
  }
  else
    reduction.qp = mprgp.solve(qp, reduction.lambda);
  if (!reduction.qp.converged)
    throw NumericalFailure(not_converged(reduction.qp, qp.d.size(), settings.tolerance));
  if (scene.solver.condition_number)
  {
    reduction.condition_raw = condition_number(qp.S);
    reduction.condition_scaled = condition_number(scaled_by_diagonal(qp.S));
  }
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
  return mark(scene.adaptivity, degrees, estimate,
              [&](const unsigned int cell)
              { return smoothness.decay_rate(solution, tables, cell); });
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
