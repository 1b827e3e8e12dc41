// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_balance_solver_h
#define hpvi_balance_solver_h

#include <hpvi/solver/mprgp.h>

#include <functional>

namespace hpvi
{
/** `G'z = e`, one equation. */
struct EqualityConstraint
{
  dealii::Vector<double> G;
  double e;
};

/**
 * `min 1/2 z'Sz - d'z` over a box and `G'z = e`, where S and d contain a penalty already:
 * `S = S_0 + c G G'`, `d = d_0 + c e G`. The method of multipliers repeats the problem in the box
 * with `d + alpha G` and moves alpha by `c (e - G'z)` (Dostal, Optimal Quadratic Programming
 * Algorithms, 2009, chapter 6). That is slow where the falling function `e - G'z` of alpha is flat:
 * steps are doubled until its zero is bracketed, then found by Boost's TOMS 748.
 *
 * For a body that only friction holds, G'z = e is the balance of forces along its free translation
 * and alpha the length by which it moves.
 */
class BalanceSolver
{
public:
  /** Solves a problem in the box, from a starting value that receives the minimiser. */
  using Inner = std::function<QpReport(const QuadraticProgram &, dealii::Vector<double> &)>;

  /** @p penalty is c; the equation holds to @p tolerance |G|_1 at the end. */
  BalanceSolver(Inner inner, double penalty, double tolerance);

  /**
   * z holds the starting value and receives the minimiser; @p alpha likewise. The report adds up
   * the inner problems.
   */
  QpReport solve(QuadraticProgram qp, const EqualityConstraint &constraint,
                 dealii::Vector<double> &z, double &alpha) const;

private:
  Inner inner;
  double penalty, tolerance;
};
} // namespace hpvi

#endif
