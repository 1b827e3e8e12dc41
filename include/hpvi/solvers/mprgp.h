// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mprgp_h
#define hpvi_mprgp_h

#include <hpvi/solvers/quadratic_program.h>

namespace hpvi
{
/** What a run of a QP solver cost and how it ended. */
struct QpReport
{
  bool converged = false;
  unsigned int multiplications = 0; ///< products with S, of all kinds
  unsigned int cg_steps = 0;
  unsigned int expansion_steps = 0;
  unsigned int proportioning_steps = 0;
  unsigned int dense_solves = 0; ///< Cholesky factorisations of a part of S
  bool fell_back = false;        ///< begun by ActiveSet and ended by Mprgp
  double projected_gradient = 0; ///< |nu| / max(|d|, |S z_0|) at the end, in scaled variables

  /** Adds the counts of @p part; how the run ended is how this part did. */
  QpReport &operator+=(const QpReport &part);
};

/**
 * Modified proportioning with reduced gradient projections for boxes: Algorithm 1 of the thesis
 * (Section 5.1; Dostal & Schoeberl 2005, doi:10.1007/s10589-005-4557-7) with the improvements that
 * measurement asked for: diagonal scaling, projected-CG expansion, a step length below 2/|S| from
 * an upper estimate of |S|, proportioning that stops at the wall.
 */
class Mprgp
{
public:
  struct Settings
  {
    double tolerance = 1e-9; ///< |nu| <= tolerance * max(|d|, |S z_0|), scaled variables
    unsigned int maximum_multiplications = 100000;
    double gamma = 1.;            ///< proportioning parameter Gamma
    bool diagonal_scaling = true; ///< iterate in y_i = sqrt(S_ii) z_i
  };

  explicit Mprgp(const Settings &settings);

  /**
   * Solve @p qp; @p z holds the starting value (projected onto the box first) and receives the
   * minimiser, or the last iterate. Components on a wall are exactly on it.
   *
   * Never throws for lack of convergence: the report says so. The run gives up when the products
   * are used up (a step that has begun is finished: at most three more), when round-off keeps the
   * gradient from falling to the tolerance, when q has no minimum in the box, and on NaN.
   */
  QpReport solve(const QuadraticProgram &qp, dealii::Vector<double> &z) const;

private:
  Settings settings;
};
} // namespace hpvi

#endif
