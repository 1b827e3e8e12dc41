// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_active_set_h
#define hpvi_active_set_h

#include <hpvi/solvers/mprgp.h>

namespace hpvi
{
/**
 * The primal-dual active set method for boxes, a semismooth Newton method (Hintermueller, Ito &
 * Kunisch 2002, doi:10.1137/S1052623401383558). With the gradient `r = S z - d` a step predicts
 *
 *     z_i = u_i where z_i - r_i / S_ii > u_i,   z_i = l_i where z_i - r_i / S_ii < l_i,
 *
 * and solves `r_i = 0` for the other components by a dense Cholesky factorisation. Once the
 * prediction stays, z is the minimiser. From a good start that takes two or three steps, but
 * nothing falls from step to step, so that it may cycle.
 */
class ActiveSet
{
public:
  /** Tolerance and limits mean what they mean to Mprgp. */
  explicit ActiveSet(const Mprgp::Settings &settings);

  /**
   * Solve @p qp; @p z holds the starting value and receives the minimiser, or the last iterate, as
   * in Mprgp::solve(). When a prediction comes again without being right, when the matrix of the
   * free components is not positive definite, or when round-off keeps the gradient above the
   * tolerance, Mprgp goes on from the last iterate: the report says so and counts its products.
   */
  QpReport solve(const QuadraticProgram &qp, dealii::Vector<double> &z) const;

private:
  Mprgp::Settings settings;
};
} // namespace hpvi

#endif
