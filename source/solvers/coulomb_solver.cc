// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/solvers/cone_newton.h>
#include <hpvi/solvers/coulomb_solver.h>
#include <hpvi/solvers/pressure_iteration.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int maximum_fixed_points = 200;
constexpr unsigned int accelerated_start = 15; ///< steps of the fixed point before Newton's method

/** One run: where it stands, and the ways to move. */
struct Run
{
  Run(const ConeProgram &program, const Mprgp::Settings &settings, const Vector<double> &z,
      const Vector<double> &alpha)
      : iterate(program, settings, z, alpha), steps(iterate), pressures(iterate)
  {
  }

  CoulombReport newton(bool warm, unsigned int first_rung);
  CoulombReport fixed_point(bool warm);
  CoulombReport report(const char *method, bool fell_back) const;
  bool raise_friction();

  ConeIterate iterate;
  ConeNewton steps;
  PressureIteration pressures;
};

CoulombReport Run::newton(const bool warm, const unsigned int first_rung)
{
  const auto step_on = [&](const ConeNewton::State &state) { return steps.step_on_from(state); };
  const std::vector<std::pair<const char *, std::function<bool()>>> ladder = {
      {"newton", [&] { return step_on(warm ? steps.predict() : steps.stick()); }},
      {"newton from frictionless", [&] { return step_on(steps.stick_where_closed()); }},
      {"line search", [&] { return steps.search_lines(); }},
      {"anderson", [&] { return pressures.run(accelerated_start) || step_on(steps.predict()); }},
      {"continuation", [&] { return raise_friction(); }}};
  unsigned int rung = first_rung;
  for (;; ++rung)
  {
    if (rung > 0)
      pressures.minimise_without_friction();
    if (ladder[rung].second() || rung + 1 == ladder.size())
      break;
  }
  return report(ladder[rung].first, rung > 0);
}

CoulombReport Run::fixed_point(const bool warm)
{
  if (!warm)
    pressures.minimise_without_friction(); // sides of zero may leave no balance
  pressures.run(maximum_fixed_points);
  return report("fixed point", false);
}

/** Newton's method with a small coefficient first. A level that cannot be solved is left out. */
bool Run::raise_friction()
{
  const FrictionCones &all = iterate.program.set;
  const auto solve = [&] { return steps.step_on_from(steps.predict()) || steps.search_lines(); };
  double largest = 0;
  for (const FrictionCones::Cone &cone : all.cones)
    largest = std::max(largest, cone.friction.coefficient);
  FrictionCones less = all;
  iterate.set = &less;
  double level = std::min(0.5, 0.25 * largest);
  for (; level < largest; level *= 1.5)
  {
    for (unsigned int k = 0; k < less.cones.size(); ++k)
      less.cones[k].friction.coefficient = all.cones[k].friction.coefficient * (level / largest);
    const ConeIterate::Point old = iterate.point;
    if (!solve())
      iterate.point = old;
  }
  iterate.set = &all;
  return solve();
}

CoulombReport Run::report(const char *const method, const bool fell_back) const
{
  CoulombReport result;
  result.qp = iterate.cost;
  result.newton_steps = steps.steps;
  result.fixed_point_steps = pressures.steps;
  result.contraction = pressures.contraction;
  result.residual = result.qp.projected_gradient = iterate.residual_of_best;
  result.method = method;
  result.qp.converged = result.residual <= iterate.settings.tolerance;
  result.qp.dense_solves += steps.steps;
  result.qp.fell_back = fell_back;
  return result;
}
} // namespace

CoulombSolver::CoulombSolver(const Mprgp::Settings &settings, const Method method,
                             const unsigned int first_rung)
    : settings(settings), method(method), first_rung(first_rung)
{
}

CoulombReport CoulombSolver::solve(const ConeProgram &program, Vector<double> &z,
                                   Vector<double> &alpha, const bool warm) const
{
  AssertDimension(program.S.n(), z.size());
  AssertDimension(program.d.size(), z.size());
  AssertDimension(program.set.fixed.size(), z.size());
  AssertDimension(program.balance.e.size(), alpha.size());
  CoulombReport report;
  report.qp.converged = z.size() == 0;
  if (report.qp.converged)
    return report;
  if (!warm)
  {
    z = 0.;
    alpha = 0.;
  }
  if (!std::isfinite(program.S.frobenius_norm()) || !std::isfinite(program.d.l2_norm()) ||
      !std::isfinite(z.l2_norm()))
  {
    report.residual = report.qp.projected_gradient = std::numeric_limits<double>::quiet_NaN();
    return report;
  }
  Run run(program, settings, z, alpha);
  report = method == Method::newton ? run.newton(warm, first_rung) : run.fixed_point(warm);
  z = run.iterate.best.z;
  alpha = run.iterate.best.alpha;
  return report;
}

double CoulombSolver::difference_from_second_start(const ConeProgram &program,
                                                   const Vector<double> &z) const
{
  Vector<double> other(z.size()), alpha(program.balance.e.size());
  if (!CoulombSolver(settings, Method::newton, 1).solve(program, other, alpha, false).qp.converged)
    return std::numeric_limits<double>::quiet_NaN();
  const auto size = [&](const Vector<double> &x)
  {
    Vector<double> product(x.size());
    program.S.vmult(product, x);
    return std::sqrt(std::max(0., x * product));
  };
  const double largest = std::max(size(z), size(other));
  other -= z;
  return largest == 0. ? 0. : size(other) / largest;
}
} // namespace hpvi
