// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/timer.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/discretisation/reduced_problem.h>
#include <hpvi/solver/active_set.h>
#include <hpvi/solver/balance_solver.h>

#include <cmath>
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
void check_equilibrium(const RigidMotion<dim> &motion, const ContactSpace<dim> &contact_space)
{
  const double applied = std::abs(motion.load), available = contact_space.friction_limit(),
               discrete = contact_space.discrete_friction_limit();
  const auto exceeds = [&](const double limit) { return applied > limit * (1 + 1e-10); };
  if (!exceeds(available) && !exceeds(discrete))
    return;
  std::ostringstream line;
  line.precision(10); // the two may be close
  line << "no equilibrium: the loads push the body along (" << motion.direction << ") with "
       << applied << ", friction can resist with ";
  if (exceeds(available))
    line << available << " at most; add a support, raise Friction bound or lower the loads";
  else
    line << available << " but on this mesh with " << discrete
         << " only, for Friction bound varies between the points of the multiplier; raise "
            "Geometry/Subdivisions or set Geometry/Graded towards where it does";
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
  if (const auto &motion = discretisation.free_motion)
  {
    check_equilibrium(*motion, contact_space);
    // The inner problems leave noise of their own tolerance in the balance.
    EqualityConstraints balance{FullMatrix<double>(qp.d.size(), 1), Vector<double>(1)};
    for (unsigned int i = 0; i < qp.d.size(); ++i)
      balance.G(i, 0) = motion->G[i];
    balance.e[0] = motion->load;
    FullMatrix<double> penalty(1, 1);
    penalty(0, 0) = motion->penalty();
    Vector<double> alpha(1);
    alpha[0] = result.translation;
    result.qp = BalanceSolver(solve, penalty, 100 * settings.qp_tolerance)
                    .solve(qp, balance, result.z, alpha);
    result.translation = alpha[0];
    qp.d.add(result.translation, motion->G);
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
