// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numbers.h>
#include <hpvi/solvers/active_set.h>
#include <hpvi/solvers/anderson.h>
#include <hpvi/solvers/balance_solver.h>
#include <hpvi/solvers/pressure_iteration.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int patience = 30; ///< steps in which the residual must halve
} // namespace

PressureIteration::PressureIteration(ConeIterate &iterate) : iterate(iterate), point(iterate.point)
{
}

void PressureIteration::minimise_without_friction()
{
  point.z = 0.;
  point.alpha = 0.;
  minimise(point.alpha.size() == 0 ? iterate.set->at(point.z) : iterate.set->fixed);
}

/** In units of the scale. */
Vector<double> PressureIteration::pressures() const
{
  Vector<double> x(iterate.set->cones.size());
  for (unsigned int k = 0; k < x.size(); ++k)
  {
    const unsigned int normal = iterate.set->cones[k].normal;
    x[k] = std::max(0., point.z[normal]) / iterate.scale[normal];
  }
  return x;
}

bool PressureIteration::run(const unsigned int maximum_steps)
{
  Anderson acceleration;
  Vector<double> x = pressures();
  double halved = infinity;
  for (unsigned int step = 0, since = 0; step < maximum_steps && since < patience; ++step, ++since)
  {
    Vector<double> given(point.z);
    for (unsigned int k = 0; k < x.size(); ++k)
      given[iterate.set->cones[k].normal] = x[k] * iterate.scale[iterate.set->cones[k].normal];
    const FeasibleSet frozen = iterate.set->at(given);
    ++steps;
    if (!minimise(frozen))
      return false;
    put_on_cones(frozen);
    const double residual = iterate.measure();
    if (residual <= iterate.settings.tolerance)
      return true;
    if (residual <= 0.5 * halved)
    {
      halved = residual;
      since = 0;
    }
    Vector<double> f = pressures();
    f -= x;
    x = acceleration.next(x, f);
    contraction = acceleration.contraction;
  }
  return false;
}

/** z := the solution with sides that stay */
bool PressureIteration::minimise(const FeasibleSet &feasible_set)
{
  if (!tresca)
    tresca = QuadraticProgram{iterate.program.S, iterate.program.d, {}};
  tresca->feasible_set = feasible_set;
  const BalanceSolver::Inner inner = [&](const QuadraticProgram &qp, Vector<double> &y)
  { return ActiveSet(iterate.settings).solve(qp, y); };
  const BalanceSolver outer(inner, iterate.program.penalty,
                            ConeIterate::balance_noise * iterate.settings.tolerance);
  const QpReport part = point.alpha.size() == 0
                            ? inner(*tresca, point.z)
                            : outer.solve(*tresca, iterate.program.balance, point.z, point.alpha);
  iterate.cost += part;
  point.r = iterate.gradient(point.z);
  return part.converged;
}

/** What lies on a side of Tresca's set goes to that side of its cone. */
void PressureIteration::put_on_cones(const FeasibleSet &tresca)
{
  Vector<double> lower(point.z), upper(point.z);
  for (const FrictionCones::Cone &cone : iterate.set->cones)
  {
    lower[cone.tangential] = -infinity;
    upper[cone.tangential] = infinity;
  }
  tresca.project(lower);
  tresca.project(upper);
  for (const FrictionCones::Cone &cone : iterate.set->cones)
  {
    const unsigned int t = cone.tangential;
    const double bound = cone.friction.limit(point.z[cone.normal]);
    if (lower[t] == upper[t]) // new pressure: friction resists
      point.z[t] = std::copysign(bound, -point.r[t]);
    else if (point.z[t] >= upper[t])
      point.z[t] = bound;
    else if (point.z[t] <= lower[t])
      point.z[t] = -bound;
  }
  point.r = iterate.gradient(point.z);
}
} // namespace hpvi
