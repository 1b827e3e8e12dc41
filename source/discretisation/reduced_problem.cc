// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/timer.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/discretisation/reduced_problem.h>
#include <hpvi/solver/active_set.h>
#include <hpvi/solver/augmented_lagrangian.h>

#include <cmath>
#include <numeric>
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

AugmentedLagrangian::Inner solver_in_the_box(const SolverSettings &solver)
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

/** The balance of forces along the free translation, `R'(f - B' lambda) = 0`. */
template <int dim>
EqualityConstraint balance_of_forces(const ElasticSystem<dim> &system)
{
  // A sum whose bits do not depend on threads, unlike deal.II's product.
  const double load =
      std::inner_product(system.f.begin(), system.f.end(), system.translation.begin(), 0.);
  EqualityConstraint result{Vector<double>(system.B.m()), load};
  for (unsigned int m = 0; m < system.B.m(); ++m)
    for (unsigned int k = 0; k < system.B.n(); ++k)
      result.G[m] += system.B(m, k) * system.translation[system.contact_unknowns[k]];
  return result;
}

/**
 * Friction can carry int g at most: where the loads ask for more there is no equilibrium. The
 * discrete problem may still have one, with |lambda| > 1 between the Gauss points: |G|_1 is larger
 * where g is no polynomial.
 */
template <int dim>
void check_equilibrium(const Scene<dim> &scene, const ContactSpace<dim> &contact_space,
                       const EqualityConstraint &balance)
{
  const double applied = std::abs(balance.e), available = contact_space.friction_limit();
  if (applied <= available * (1 + 1e-10))
    return;
  std::ostringstream line;
  line.precision(10); // the two may be close
  line << "no equilibrium: the loads push the body along (" << *scene.free_translation()
       << ") with " << applied << ", friction can resist with " << available
       << " at most; add a support, raise Friction bound or lower the loads";
  throw NumericalFailure(line.str());
}
} // namespace

template <int dim>
Reduction solve_reduced_problem(const Scene<dim> &scene, const ContactSpace<dim> &contact_space,
                                const ElasticSystem<dim> &system,
                                const SchurComplement &schur_complement,
                                const Vector<double> &defect, Reduction start)
{
  const Timer timer;
  Reduction result = std::move(start);
  QuadraticProgram qp{schur_complement.S(), schur_complement.d(), contact_space.feasible_set()};
  qp.d += system.B_prescribed;
  qp.d += defect;
  const AugmentedLagrangian::Inner solve = solver_in_the_box(scene.solver);
  if (scene.free_translation())
  {
    const EqualityConstraint balance = balance_of_forces(system);
    check_equilibrium(scene, contact_space, balance);
    // The inner problems leave noise of their own tolerance in the balance.
    result.qp = AugmentedLagrangian(solve, 1 / system.spring, 100 * scene.solver.qp_tolerance)
                    .solve(qp, balance, result.lambda, result.translation);
    qp.d.add(result.translation, balance.G);
  }
  else
    result.qp = solve(qp, result.lambda);
  result.moments = qp.d;
  Vector<double> product(qp.d.size());
  qp.S.vmult(product, result.lambda);
  result.moments -= product;
  if (!result.qp.converged)
    throw NumericalFailure(not_converged(result.qp, qp.d.size(), scene.solver.qp_tolerance));
  if (scene.solver.condition_number)
  {
    result.condition_raw = condition_number(qp.S);
    result.condition_scaled = condition_number(scaled_by_diagonal(qp.S));
  }
  result.seconds += timer.wall_time();
  return result;
}

template Reduction solve_reduced_problem(const Scene<2> &, const ContactSpace<2> &,
                                         const ElasticSystem<2> &, const SchurComplement &,
                                         const Vector<double> &, Reduction);
} // namespace hpvi
