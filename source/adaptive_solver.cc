// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/timer.h>
#include <hpvi/adaptive_solver.h>
#include <hpvi/refinement_strategy.h>
#include <hpvi/schur_complement.h>

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
                 const Degrees &degrees)
      : displacement_space(scene, triangulation, degrees), contact_space(scene, displacement_space)
  {
  }
};

/** What the solution of the reduced problem brings besides the multiplier. */
struct Reduction
{
  Vector<double> lambda;
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
  std::unique_ptr<Discretisation<dim>> discretisation;
  StageTimes times; ///< of the current step

  explicit Stages(const Scene<dim> &scene)
      : scene(scene), stiffnesses(scene, tables), smoothness(scene.adaptivity.reading)
  {
    make_mesh(scene, triangulation);
    degrees.assign(triangulation.n_active_cells(), scene.adaptivity.start_degree);
  }

  void discretise();
  Solution<dim> solve(Reduction &reduction);
  void solve_for_multiplier(const SchurComplement &schur_complement, Reduction &reduction);
  ErrorEstimate estimate(const Solution<dim> &solution);
  bool refine(const Solution<dim> &solution, const ErrorEstimate &estimate);
};

template <int dim>
void AdaptiveSolver<dim>::Stages::discretise()
{
  std::unique_ptr<Discretisation<dim>> next;
  {
    StageTimer timer(times.setup);
    next = std::make_unique<Discretisation<dim>>(scene, triangulation, degrees);
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
    schur_complement = std::make_unique<const SchurComplement>(system.A, system.f, system.unknowns,
                                                               system.contact_unknowns, system.B);
  }
  if (discretisation->contact_space.n_multipliers() > 0)
    solve_for_multiplier(*schur_complement, reduction);

  StageTimer timer(times.recover);
  Vector<double> u = schur_complement->displacement(reduction.lambda);
  system.recover(u);
  return {scene, discretisation->displacement_space, discretisation->contact_space, std::move(u),
          reduction.lambda};
}

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
  reduction.qp = Mprgp(settings).solve(qp, reduction.lambda);
  if (!reduction.qp.converged)
    throw NumericalFailure("the quadratic program for the multiplier (" +
                           std::to_string(qp.d.size()) + " unknowns) has not converged after " +
                           std::to_string(reduction.qp.multiplications) +
                           " products with S: relative projected gradient " +
                           std::to_string(reduction.qp.projected_gradient) + ", tolerance " +
                           std::to_string(settings.tolerance) +
                           "; raise Solver/QP maximum multiplications or Solver/QP tolerance");
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
bool AdaptiveSolver<dim>::Stages::refine(const Solution<dim> &solution,
                                         const ErrorEstimate &estimate)
{
  Refinement refinement;
  {
    StageTimer timer(times.decide);
    refinement = mark(scene.adaptivity, degrees, estimate,
                      [&](const unsigned int cell)
                      { return smoothness.decay_rate(solution, tables, cell); });
  }
  if (refinement.is_empty(degrees))
    return false;
  StageTimer timer(times.refine);
  degrees = refine_mesh(triangulation, degrees, refinement);
  return true;
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene)
    : stages(std::make_unique<Stages>(scene))
{
}

template <int dim>
AdaptiveSolver<dim>::~AdaptiveSolver() = default;

template <int dim>
void AdaptiveSolver<dim>::run(const std::function<void(const Step<dim> &)> &finished_step)
{
  const Adaptivity &adaptivity = stages->scene.adaptivity;
  double seconds = 0;
  for (unsigned int number = 1;; ++number)
  {
    stages->discretise();
    Reduction reduction;
    const Solution<dim> solution = stages->solve(reduction);
    const ErrorEstimate estimate = stages->estimate(solution);
    Energies step_energies;
    {
      StageTimer timer(stages->times.recover);
      step_energies = energies(solution, *stages->discretisation->system, stages->tables);
    }
    seconds += stages->times.total();
    finished_step({number, solution, estimate, step_energies, reduction.qp, reduction.condition_raw,
                   reduction.condition_scaled, stages->times, seconds});

    stages->times = StageTimes();
    if (number >= adaptivity.maximum_steps ||
        solution.displacement_space.n_free_dofs() >= adaptivity.maximum_unknowns ||
        !stages->refine(solution, estimate))
      return;
  }
}

template class AdaptiveSolver<2>;
} // namespace hpvi
