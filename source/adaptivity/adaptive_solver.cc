// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/timer.h>
#include <hpvi/adaptivity/adaptive_solver.h>
#include <hpvi/adaptivity/marking.h>
#include <hpvi/adaptivity/warnings.h>
#include <hpvi/base/dense_work.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/text.h>
#include <hpvi/contact/multiplier_trace.h>
#include <hpvi/discretisation/iterative_refinement.h>
#include <hpvi/discretisation/reduced_problem.h>

#include <cmath>
#include <limits>
#include <numeric>
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

/** What overflows must not pass for a result. */
void check_finite(const char *const name, const double value)
{
  if (!std::isfinite(value))
    throw NumericalFailure(std::string(name) + " is not finite: numbers overflow or elements are "
                                               "degenerate; choose units in which loads, Friction "
                                               "bound and Young's modulus are moderate");
}

/** Nor what underflows: energies are squares, of which a small solution would leave zero. */
template <int dim>
void check_underflow(const Solution<dim> &solution)
{
  const double largest = solution.u.linfty_norm();
  const double negligible =
      std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
  for (const Material &material : solution.scene.materials) // the softest part may hold it all
    if (largest > 0 && material.young * largest * largest < negligible)
      throw NumericalFailure("the energy underflows: Young's modulus " + to_string(material.young) +
                             " and displacements up to " + to_string(largest) +
                             "; choose units in which loads are moderate");
}

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
  double seconds = 0;
  unsigned int number = 0; ///< of the last finished step
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
  Refinement decide(const Solution<dim> &solution, const ErrorEstimate &estimate);
  Step<dim> report(const Solution<dim> &solution, const ErrorEstimate &estimate,
                   const Reduction &reduction);
  void refine(const Refinement &refinement);
};

template <int dim>
void AdaptiveSolver<dim>::Stages::begin(const std::string &stage, const std::string &note) const
{
  about_to({number + 1, stage, note});
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
Refinement AdaptiveSolver<dim>::Stages::decide(const Solution<dim> &solution,
                                               const ErrorEstimate &estimate)
{
  begin("deciding on h and p");
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
  begin("refining");
  StageTimer timer(times.refine);
  degrees = refine_mesh(triangulation, degrees, refinement);
}

template <int dim>
AdaptiveSolver<dim>::AdaptiveSolver(const Scene<dim> &scene)
{
  scene.check(); // it may have been built by code, or changed since it was read
  stages = std::make_unique<Stages>(scene);
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
    step_energies = energies(solution, *discretisation->system, tables, algebraic.energy_product);
    check_finite("the energy", step_energies.energy);
    check_finite("the Lagrangian", step_energies.lagrangian);
    check_finite("the energy norm", step_energies.norm);
    check_underflow(solution);
  }
  const double scaled_estimate = estimate.total() / std::sqrt(scene.coercivity());
  seconds += times.total();
  return {++number,
          solution,
          estimate,
          scaled_estimate,
          ratio(scaled_estimate, step_energies.norm),
          step_energies,
          true_error.measure(solution),
          algebraic,
          reduction.qp,
          reduction.condition_raw,
          reduction.condition_scaled,
          times,
          seconds,
          {},
          {},
          {}};
}

namespace
{
/**
 * Is the indicator no more than that of round-off in u_N? Where it is, refinement goes on for nothing.
 * Asked only where it is small, because it costs an indicator.
 */
template <int dim>
bool is_exact_to_round_off(const Step<dim> &step, const ShapeTables<dim> &tables)
{
  const Solution<dim> &solution = step.solution;
  const double small = 1e-7 * solution.scene.largest_mu() * solution.u.linfty_norm();
  return step.estimate.total() <= small &&
         step.estimate.total() <= 4 * round_off_of_estimate(solution, tables);
}

/** Which limit of the scene does this step reach, or that of numbers? Empty: none. */
template <int dim>
std::string reached_limit(const Adaptivity &limits, const Step<dim> &step,
                          const ShapeTables<dim> &tables)
{
  if (is_exact_to_round_off(step, tables))
    return "round-off";
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

void check_algebraic_error(const AlgebraicError &error)
{
  if (error.total() <= AlgebraicError::useless)
    return;
  std::ostringstream line;
  line
      << "round-off spoils the solution: its relative error is about " << error.total() << " after "
      << error.corrections
      << " corrections; the body is too slender or its supports are too weak for double precision: "
         "support it better, or choose fewer Geometry/Subdivisions and a higher degree";
  throw NumericalFailure(line.str());
}

/** Empty fields of the table are explained once. */
std::string no_condition_number(const std::vector<unsigned int> &steps)
{
  std::string list;
  for (const unsigned int step : steps)
    list += (list.empty() ? "" : ", ") + std::to_string(step);
  return "S is singular up to round-off in step " + list +
         ": there the table has no condition number; Friction bound may differ too much from point "
         "to point, or a multiplier act nowhere";
}
} // namespace

template <int dim>
void AdaptiveSolver<dim>::run(const std::function<void(const Step<dim> &)> &finished_step,
                              const std::function<void(const Progress &)> &about_to)
{
  stages->about_to = about_to;
  std::vector<double> estimates;
  std::vector<unsigned int> singular; ///< steps whose S has no condition number
  for (bool finished = false; !finished;)
  {
    stages->discretise();
    Reduction reduction;
    const Solution<dim> solution = stages->solve(reduction);
    const ErrorEstimate estimate = stages->estimate(solution);
    const Refinement refinement = stages->decide(solution, estimate);
    Step<dim> step = stages->report(solution, estimate, reduction);
    check_algebraic_error(step.algebraic);
    step.stopped_by = reached_limit(stages->scene.adaptivity, step, stages->tables);
    if (step.stopped_by.empty() && refinement.is_empty(stages->degrees))
      step.stopped_by = nothing_marked(stages->scene.adaptivity);
    estimates.push_back(estimate.total());
    finished = !step.stopped_by.empty();
    if (!std::isfinite(step.condition_raw) || !std::isfinite(step.condition_scaled))
      singular.push_back(step.number);
    if (finished)
    {
      step.warnings = warnings(solution, stages->tables, estimates, step.algebraic);
      if (!singular.empty())
        step.warnings.push_back(no_condition_number(singular));
      if (!stages->dense_note().empty())
        step.warnings.push_back(stages->dense_note());
      step.equilibrium = equilibrium(solution, *stages->discretisation->system, stages->tables);
    }
    finished_step(step);
    stages->times = StageTimes();
    if (!finished)
      stages->refine(refinement);
  }
}

template class AdaptiveSolver<2>;
} // namespace hpvi
