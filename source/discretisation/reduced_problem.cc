// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/timer.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/discretisation/reduced_problem.h>
#include <hpvi/solver/active_set.h>
#include <hpvi/solver/balance_solver.h>

#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
std::string not_converged(const CoulombReport &report, const ConeProgram &program,
                          const SolverSettings &solver)
{
  std::ostringstream line;
  line << "Coulomb friction (" << program.d.size() << " unknowns) ";
  if (std::isnan(report.residual))
  {
    line << "holds numbers that overflow; choose units in which Friction coefficient and loads are "
            "moderate";
    return line.str();
  }
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

/**
 * The tractions of a cone |z_t| <= mu z_n as sums of `(z_n, z_t) = (1, mu), (1, -mu)`, and of (-1, 0) where
 * contact is bilateral: what it can resist is what these can with weights >= 0.
 */
std::pair<FeasibleSet, EqualityConstraints> generators(const FrictionCones &set,
                                                       const EqualityConstraints &balance)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const unsigned int n = balance.G.m(), m = balance.G.n();
  std::vector<const FrictionCones::Cone *> cone_of(n, nullptr);
  for (const FrictionCones::Cone &cone : set.cones)
    cone_of[cone.tangential] = cone_of[cone.normal] = &cone;
  std::vector<std::vector<double>> rows;
  FeasibleSet sides;
  const auto add = [&](const unsigned int i, const double factor, const unsigned int k,
                       const double other, const double lower, const double upper)
  {
    rows.emplace_back(m);
    for (unsigned int j = 0; j < m; ++j)
      rows.back()[j] = factor * balance.G(i, j) + other * balance.G(k, j);
    sides.add_interval(lower, upper);
  };
  for (unsigned int i = 0; i < n; ++i)
    if (!cone_of[i])
      add(i, 1, i, 0, set.fixed.lower_side(i), set.fixed.upper_side(i));
    else if (cone_of[i]->normal == i)
    {
      for (const double sign : {-1., 1.})
        add(i, 1, cone_of[i]->tangential, sign * cone_of[i]->mu, 0, infinity);
      if (set.fixed.lower_side(i) < 0)
        add(i, -1, i, 0, 0, infinity);
    }
  EqualityConstraints result{FullMatrix<double>(rows.size(), m), balance.e};
  for (unsigned int i = 0; i < rows.size(); ++i)
    for (unsigned int j = 0; j < m; ++j)
      result.G(i, j) = rows[i][j];
  return {sides, result};
}

/** The same for what friction and contact that can only press may do together. */
template <int dim>
void check_contact(const Scene<dim> &scene, const RigidMotions<dim> &motions,
                   const FrictionCones &set)
{
  const auto [sides, balance] = generators(set, motions.balance());
  const std::optional<Imbalance> imbalance = find_imbalance(sides, balance);
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

template <int dim>
ReducedSolution solve_reduced_problem(const Discretisation<dim> &discretisation,
                                      const SchurComplement &schur_complement,
                                      const Vector<double> &defect, ReducedSolution start)
{
  const Timer timer;
  ReducedSolution result = std::move(start);
  const SolverSettings &settings = discretisation.scene.solver;
  const ContactSpace<dim> &contact_space = discretisation.spaces->contact_space;
  const FrictionCones set{contact_space.feasible_set(), contact_space.cones()};
  const bool is_held = discretisation.free_motions && discretisation.free_motions->n_seen() > 0;
  EqualityConstraints balance;
  FullMatrix<double> penalty;
  if (is_held)
  {
    const RigidMotions<dim> &motions = *discretisation.free_motions;
    if (!discretisation.scene.has_pressure() && motions.n_seen() == 1)
      check_friction(motions, contact_space); // knows more to say
    check_contact(discretisation.scene, motions, set);
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
    throw NumericalFailure(not_converged(result.qp, d.size(), settings.qp_tolerance));
  if (settings.condition_number)
  {
    result.condition_raw = condition_number(schur_complement.S());
    result.condition_scaled = condition_number(scaled_by_diagonal(schur_complement.S()));
  }
  result.seconds += timer.wall_time();
  return result;
}

template ReducedSolution solve_reduced_problem(const Discretisation<2> &, const SchurComplement &,
                                               const Vector<double> &, ReducedSolution);
} // namespace hpvi
