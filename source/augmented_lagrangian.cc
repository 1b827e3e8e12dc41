// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/augmented_lagrangian.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * Finds the zero of a falling function from values at its own proposals: steps of c times the
 * value, which never go too far while the slope is above -1/c, and at least twice the step before,
 * until the zero is between two proposals; then the secant by Illinois's rule.
 */
class FallingZero
{
public:
  explicit FallingZero(const double penalty) : penalty(penalty)
  {
  }

  double next(const double alpha, const double value)
  {
    End &here = value > 0 ? below : above, &there = value > 0 ? above : below;
    if (last == &here)
      there.value /= 2; // else one end might stay for ever
    here = {alpha, value};
    last = &here;
    if (std::isfinite(there.alpha))
      return (below.alpha * above.value - above.alpha * below.value) / (above.value - below.value);
    step = std::copysign(std::max(penalty * std::abs(value), 2 * std::abs(step)), value);
    return alpha + step;
  }

private:
  struct End
  {
    double alpha = std::numeric_limits<double>::quiet_NaN(), value = 0;
  };

  double penalty, step = 0;
  End below, above;
  const End *last = nullptr;
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
