// SPDX-License-Identifier: LGPL-2.1-or-later
#include <boost/math/tools/toms748_solve.hpp>
#include <hpvi/solver/balance_solver.h>

#include <cmath>
#include <cstdint>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
void add(QpReport &sum, const QpReport &part)
{
  sum.converged = part.converged;
  sum.multiplications += part.multiplications;
  sum.cg_steps += part.cg_steps;
  sum.expansion_steps += part.expansion_steps;
  sum.proportioning_steps += part.proportioning_steps;
  sum.dense_solves += part.dense_solves;
  sum.fell_back = sum.fell_back || part.fell_back;
  sum.projected_gradient = part.projected_gradient;
}
} // namespace

BalanceSolver::BalanceSolver(Inner inner, const double penalty, const double tolerance)
    : inner(std::move(inner)), penalty(penalty), tolerance(tolerance)
{
}

QpReport BalanceSolver::solve(QuadraticProgram qp, const EqualityConstraint &constraint,
                              Vector<double> &z, double &alpha) const
{
  const Vector<double> d(qp.d);
  QpReport report;
  bool met = false;
  // e - G'z falls with alpha; zero where it is small enough, or where to go on makes no sense.
  const auto gap = [&](const double trial)
  {
    alpha = trial;
    qp.d = d;
    qp.d.add(alpha, constraint.G);
    add(report, inner(qp, z));
    const double value = constraint.e - constraint.G * z;
    met = report.converged && std::abs(value) <= tolerance * constraint.G.l1_norm();
    return met || !report.converged ? 0. : value;
  };

  double here = alpha, value = gap(here), last = here, last_value = value;
  std::uintmax_t evaluations = 100;
  for (double step = penalty * value; value != 0. && last_value * value >= 0. && evaluations > 0;
       step *= 2, --evaluations)
  {
    last = here;
    last_value = value;
    here += step;
    value = gap(here);
  }
  if (value != 0. && last_value * value < 0.)
  {
    if (here < last)
    {
      std::swap(here, last);
      std::swap(value, last_value);
    }
    boost::math::tools::toms748_solve(gap, last, here, last_value, value,
                                      boost::math::tools::eps_tolerance<double>(), evaluations);
  }
  report.converged = met;
  return report;
}
} // namespace hpvi
