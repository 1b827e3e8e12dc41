// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/augmented_lagrangian.h>

#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * Finds the zero of a falling function from values at its own proposals. Its slope is known to lie in
 * (-1/c, 0], so that c times the value never goes too far; a secant goes farther.
 */
class FallingZero
{
public:
  explicit FallingZero(const double penalty) : penalty(penalty)
  {
  }

  double next(const double alpha, const double value)
  {
    (value > 0 ? lower : upper) = alpha;
    double proposal = alpha + penalty * value;
    const double secant = alpha - value * (alpha - last_alpha) / (value - last_value);
    if (std::isfinite(secant) && secant > lower && secant < upper &&
        std::abs(secant - alpha) > std::abs(proposal - alpha))
      proposal = secant;
    last_alpha = alpha;
    last_value = value;
    return proposal;
  }

private:
  double penalty;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double last_alpha = std::numeric_limits<double>::quiet_NaN(), last_value = 0;
};

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

AugmentedLagrangian::AugmentedLagrangian(Inner inner, const double penalty, const double tolerance)
    : inner(std::move(inner)), penalty(penalty), tolerance(tolerance)
{
}

QpReport AugmentedLagrangian::solve(QuadraticProgram qp, const EqualityConstraint &constraint,
                                    Vector<double> &z, double &alpha) const
{
  const Vector<double> d(qp.d);
  FallingZero zero(penalty);
  QpReport report;
  for (unsigned int step = 0; step < 100; ++step)
  {
    qp.d = d;
    qp.d.add(alpha, constraint.G);
    add(report, inner(qp, z));
    const double gap = constraint.e - constraint.G * z;
    if (!report.converged || std::abs(gap) <= tolerance * constraint.G.l1_norm())
      return report;
    alpha = zero.next(alpha, gap);
  }
  report.converged = false;
  return report;
}
} // namespace hpvi
