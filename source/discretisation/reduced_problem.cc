// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/timer.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/discretisation/reduced_problem.h>
#include <hpvi/solver/active_set.h>
#include <hpvi/solver/balance_solver.h>

#include <cmath>
#include <optional>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
std::string not_converged(const QpReport &report, const unsigned int size, const double tolerance)
{
  std::ostringstream line;
  line << "the quadratic program for the multiplier (" << size << " unknowns) ";
  if (std::isnan(report.projected_gradient))
    line << "holds numbers that overflow; choose units in which Friction bound and loads are "
            "moderate";
  else
    line << "has not converged after " << report.multiplications
         << " products with S: relative projected gradient " << report.projected_gradient
         << ", tolerance " << tolerance
         << "; raise Solver/QP maximum multiplications or Solver/QP tolerance";
  return line.str();
}

BalanceSolver::Inner solver_in_the_set(const SolverSettings &solver)
{
  Mprgp::Settings settings;
  settings.tolerance = solver.qp_tolerance;
  settings.maximum_multiplications = solver.qp_maximum_multiplications;
  settings.diagonal_scaling = solver.diagonal_scaling;
  if (solver.qp_solver == QpSolver::active_set)
    return [active_set = ActiveSet(settings)](const QuadraticProgram &qp, Vector<double> &z)
    { return active_set.solve(qp, z); };
  return [mprgp = Mprgp(settings)](const QuadraticProgram &qp, Vector<double> &z)
  { return mprgp.solve(qp, z); };
}

/**
 * Friction can carry int g at most: where the loads ask for more there is no equilibrium. The discrete
 * problem can carry `sum w_i g(x_i)`, which is another number where g varies between the points.
 */
template <int dim>
void check_friction(const RigidMotions<dim> &motions, const ContactSpace<dim> &contact_space)
{
  const double applied = std::abs(motions.balance().e[0]),
               available = contact_space.friction_limit(),
               discrete = contact_space.discrete_friction_limit();
  const auto exceeds = [&](const double limit) { return applied > limit * (1 + 1e-10); };
  if (!exceeds(available) && !exceeds(discrete))
    return;
  std::ostringstream line;
  line.precision(10); // the two may be close
  line << "no equilibrium: the loads push the body "
       << motions.motion(Vector<double>({1.})).direction() << " with " << applied
       << ", friction can resist with ";
  if (exceeds(available))
    line << available << " at most; add a support, raise Friction bound or lower the loads";
  else
    line << available << " but on this mesh with " << discrete
         << " only, for Friction bound varies between the points of the multiplier; raise "
            "Geometry/Subdivisions or set Geometry/Graded towards where it does";
  throw NumericalFailure(line.str());
}

/** The same for what friction and contact that can only press may do together. */
template <int dim>
void check_contact(const Scene<dim> &scene, const RigidMotions<dim> &motions,
                   const FeasibleSet &feasible_set)
{
  const std::optional<Imbalance> imbalance = find_imbalance(feasible_set, motions.balance());
  if (!imbalance)
    return;
  RigidBodyMotion<dim> motion = motions.motion(imbalance->motion);
  // A rotation about a far point is one more to read than a sliding body.
  if (std::abs(motion.rotation) * scene.geometry.corners[0].distance(motion.centre) <
      0.1 * motion.translation.norm())
    motion.rotation = 0;
  const bool pushes = motion.is_translation();
  // Of unit length, or with a rotation by one, so that the numbers are forces or moments.
  const double unit = pushes ? motion.translation.norm() : std::abs(motion.rotation);
  std::ostringstream line;
  line.precision(10);
  line << "no equilibrium: the loads " << (pushes ? "push" : "turn") << " the body "
       << motion.direction() << " with " << imbalance->load / unit << ", contact can resist with "
       << imbalance->resistance / unit
       << " at most; add a support, raise Friction bound or change the loads";
  throw NumericalFailure(line.str());
}
} // namespace

template <int dim>
ReducedSolution solve_reduced_problem(const Discretisation<dim> &discretisation,
                                      const SchurComplement &schur_complement,
                                      const Vector<double> &defect, ReducedSolution start)
{
  const Timer timer;
  ReducedSolution result = std::move(start);
  const SolverSettings &settings = discretisation.scene.solver;
  const ContactSpace<dim> &contact_space = discretisation.spaces->contact_space;
  QuadraticProgram qp{schur_complement.S(), schur_complement.d(), contact_space.feasible_set()};
  qp.d += defect;
  const BalanceSolver::Inner solve = solver_in_the_set(settings);
  if (const auto &motions = discretisation.free_motions; motions && motions->n_seen() > 0)
  {
    if (!discretisation.scene.has_unilateral_contact() && motions->n_seen() == 1)
      check_friction(*motions, contact_space); // knows more to say
    check_contact(discretisation.scene, *motions, qp.feasible_set);
    if (result.motion.size() == 0)
      result.motion.reinit(motions->n_seen());
    // The inner problems leave noise of their own tolerance in the balance.
    result.qp = BalanceSolver(solve, motions->penalty(), 100 * settings.qp_tolerance)
                    .solve(qp, motions->balance(), result.z, result.motion);
    qp.d += motions->balance().along(result.motion);
  }
  else
    result.qp = solve(qp, result.z);
  result.moments = qp.d;
  Vector<double> product(qp.d.size());
  qp.S.vmult(product, result.z);
  result.moments -= product;
  if (!result.qp.converged)
    throw NumericalFailure(not_converged(result.qp, qp.d.size(), settings.qp_tolerance));
  if (settings.condition_number)
  {
    result.condition_raw = condition_number(qp.S);
    result.condition_scaled = condition_number(scaled_by_diagonal(qp.S));
  }
  result.seconds += timer.wall_time();
  return result;
}

template ReducedSolution solve_reduced_problem(const Discretisation<2> &, const SchurComplement &,
                                               const Vector<double> &, ReducedSolution);
} // namespace hpvi
