// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/timer.h>
#include <hpvi/base/finite.h>
#include <hpvi/plane/reduced_problem.h>
#include <hpvi/solvers/active_set.h>
#include <hpvi/solvers/balance_solver.h>

#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
std::string no_number(const std::string &entry, const Vector<double> &d)
{
  if (overflows(d.linfty_norm()))
    return "numbers that overflow; choose units in which " + entry + " and loads are moderate";
  return "what is no number, as 0 divided by 0; look for cells without area and edges without "
         "length";
}

std::string not_converged(const CoulombReport &report, const ConeProgram &program,
                          const SolverSettings &solver)
{
  std::ostringstream line;
  line << "Coulomb friction (" << program.d.size() << " unknowns) ";
  if (std::isnan(report.residual))
    return line.str() + "holds " + no_number("Friction coefficient", program.d);
  line << "has not converged after " << report.newton_steps << " steps of Newton's method and "
       << report.fixed_point_steps << " problems of Tresca: relative residual " << report.residual
       << ", tolerance " << solver.qp_tolerance;
  if (report.contraction > 0)
    line << ", contraction number " << report.contraction;
  line << "; set Solver/Coulomb solver = "
       << (solver.coulomb_method == CoulombMethod::newton ? "fixed point" : "newton")
       << ", raise Geometry/Subdivisions, or lower Friction coefficient, for where it is large "
          "there "
          "may be no solution";
  if (program.balance.e.size() > 0)
    line << "; or add a support: contact and friction alone may not hold the body";
  return line.str();
}

std::string not_converged(const QpReport &report, const Vector<double> &d, const double tolerance)
{
  std::ostringstream line;
  line << "the quadratic program for the multiplier (" << d.size() << " unknowns) ";
  if (std::isnan(report.projected_gradient))
    line << "holds " << no_number("Friction bound", d);
  else
    line << "has not converged after " << report.multiplications
         << " products with S: relative projected gradient " << report.projected_gradient
         << ", tolerance " << tolerance
         << "; raise Solver/QP maximum multiplications or Solver/QP tolerance";
  return line.str();
}

Mprgp::Settings qp_settings(const SolverSettings &solver)
{
  Mprgp::Settings settings;
  settings.tolerance = solver.qp_tolerance;
  settings.maximum_multiplications = solver.qp_maximum_multiplications;
  settings.diagonal_scaling = solver.diagonal_scaling;
  return settings;
}

BalanceSolver::Inner solver_in_the_set(const SolverSettings &solver)
{
  const Mprgp::Settings settings = qp_settings(solver);
  if (solver.qp_solver == QpSolver::active_set)
    return [active_set = ActiveSet(settings)](const QuadraticProgram &qp, Vector<double> &z)
    { return active_set.solve(qp, z); };
  return [mprgp = Mprgp(settings)](const QuadraticProgram &qp, Vector<double> &z)
  { return mprgp.solve(qp, z); };
}

void solve_cones(const ConeProgram &program, const SolverSettings &solver, ReducedSolution &result)
{
  const auto method = solver.coulomb_method == CoulombMethod::newton
                          ? CoulombSolver::Method::newton
                          : CoulombSolver::Method::fixed_point;
  const bool warm = !result.z.all_zero();
  const CoulombSolver coulomb_solver(qp_settings(solver), method);
  result.coulomb = coulomb_solver.solve(program, result.z, result.motion, warm);
  result.qp = result.coulomb.qp;
  if (!result.qp.converged)
    throw NumericalFailure(not_converged(result.coulomb, program, solver));
  if (solver.check_uniqueness)
    result.coulomb.difference = coulomb_solver.difference_from_second_start(program, result.z);
}
} // namespace

ReducedSolution solve_reduced_problem(const Discretisation<2> &discretisation,
                                      const SchurComplement &schur_complement,
                                      const Vector<double> &defect, ReducedSolution start)
{
  const Timer timer;
  ReducedSolution result = std::move(start);
  const SolverSettings &settings = discretisation.scene.solver;
  const ContactSpace<2> &contact_space = discretisation.spaces->contact_space;
  const FrictionCones set{contact_space.feasible_set(), contact_space.cones()};
  const bool is_held = discretisation.free_motions && discretisation.free_motions->n_seen() > 0;
  EqualityConstraints balance;
  FullMatrix<double> penalty;
  if (is_held)
  {
    const RigidMotions<2> &motions = *discretisation.free_motions;
    balance = motions.balance();
    penalty = motions.penalty();
    if (result.motion.size() == 0)
      result.motion.reinit(motions.n_seen());
  }
  Vector<double> d(schur_complement.d());
  d += defect;
  if (!set.cones.empty())
    solve_cones({schur_complement.S(), d, set, balance, penalty}, settings, result);
  else
  {
    const QuadraticProgram qp{schur_complement.S(), d, set.fixed};
    const BalanceSolver::Inner solve = solver_in_the_set(settings);
    // The inner problems leave noise of their own tolerance in the balance.
    result.qp = is_held ? BalanceSolver(solve, penalty, 100 * settings.qp_tolerance)
                              .solve(qp, balance, result.z, result.motion)
                        : solve(qp, result.z);
  }
  if (is_held)
    d += balance.along(result.motion);
  result.moments = d;
  Vector<double> product(d.size());
  schur_complement.S().vmult(product, result.z);
  result.moments -= product;
  if (!result.qp.converged)
    throw NumericalFailure(not_converged(result.qp, d, settings.qp_tolerance));
  if (settings.condition_number)
  {
    result.condition_raw = condition_number(schur_complement.S());
    result.condition_scaled = condition_number(scaled_by_diagonal(schur_complement.S()));
  }
  result.seconds += timer.wall_time();
  return result;
}
} // namespace hpvi
