// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_balance_solver_h
#define hpvi_balance_solver_h

#include <hpvi/solvers/equality_constraints.h>
#include <hpvi/solvers/mprgp.h>

#include <functional>

namespace hpvi
{
/**
 * `min 1/2 z'Sz - d'z` over a feasible set and `G'z = e`, where S and d contain a penalty already:
 * `S = S_0 + G Gamma G'`, `d = d_0 + G Gamma e`. For a body that only contact holds, G'z = e is the
 * balance of forces and moments along its free motions and alpha how far it moves along them.
 *
 * The dual function `phi(alpha) = min_z 1/2 z'Sz - (d + G alpha)'z + alpha.e` over the feasible set is
 * concave with gradient `e - G'z(alpha)`, and `-M`, `M = G_F' S_FF^-1 G_F` over the components F that are
 * free, is its generalised Hessian. Newton's method first predicts what is free for z and alpha at once,
 * as ActiveSet does for z. Then z is minimised at each alpha, and alpha moved by `M^-1 (e - G'z)`, up to
 * where phi stops growing. Where nothing free answers M is singular: there alpha moves by
 * `Gamma (e - G'z)`, the step of the method of multipliers (Dostal, Optimal Quadratic Programming
 * Algorithms, 2009, chapter 6), which is never too long, and that is doubled.
 */
class BalanceSolver
{
public:
  /** Solves a problem in the feasible set, from a starting value that receives the minimiser. */
  using Inner = std::function<QpReport(const QuadraticProgram &, dealii::Vector<double> &)>;

  /**
   * @p penalty is Gamma, symmetric positive definite. At the end EqualityConstraints::imbalance() is
   * not above the tolerance, a hundred times that of the inner problems, whose noise_of(d) it allows for.
   */
  BalanceSolver(Inner inner, dealii::FullMatrix<double> penalty, double tolerance);

  /**
   * z holds the starting value and receives the minimiser; @p alpha likewise. The report adds up
   * the inner problems and Newton's steps.
   */
  QpReport solve(const QuadraticProgram &qp, const EqualityConstraints &constraints,
                 dealii::Vector<double> &z, dealii::Vector<double> &alpha) const;

private:
  Inner inner;
  dealii::FullMatrix<double> penalty;
  double tolerance;
};
} // namespace hpvi

#endif
