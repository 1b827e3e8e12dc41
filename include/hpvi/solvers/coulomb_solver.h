// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_coulomb_solver_h
#define hpvi_coulomb_solver_h

#include <hpvi/solvers/cone_program.h>
#include <hpvi/solvers/mprgp.h>

#include <optional>
#include <string>

namespace hpvi
{
struct CoulombReport
{
  QpReport qp;                        ///< the sum; fell_back: it took more than Newton's method
  unsigned int newton_steps = 0;      ///< each one LU factorisation
  unsigned int fixed_point_steps = 0; ///< each one Tresca problem
  double contraction = 0;             ///< of the fixed point, as far as seen; 0 if it did not run
  double residual = 0;                ///< what is compared with the tolerance
  std::string method;                 ///< what ended it
  /** Of a second solution, see difference_from_second_start(); empty if none was sought. */
  std::optional<double> difference;

  /** Two solutions that differ by less are one. */
  static constexpr double same = 1e-6;
};

/**
 * Semismooth Newton's method on the whole problem: a step predicts which walls hold, which points are
 * closed, which of them stick or slip, and on which piece of its limit each slips, puts `z_t = +-limit(z_n)`,
 * linear on that piece, for those that slip, and solves `r = 0` for the rest, together with the balance, by
 * a dense LU factorisation (Alart & Curnier 1991, doi:10.1016/0045-7825(91)90022-X). A point never slips the
 * other way without a step of stick in between. Nothing falls from step to step; where a state comes again without being right there follow:
 *
 * 1. "newton from frictionless": all that frictionless contact closes sticks at first;
 * 2. "line search": steps are halved until the residual falls;
 * 3. "anderson": Newton's method from a few steps of the fixed point;
 * 4. "continuation": from a small coefficient upwards.
 *
 * The fixed point solves Tresca problems, each with the pressures of the one before, with Anderson's
 * acceleration. It contracts where mu times the coupling is small, and there the solution is unique.
 */
class CoulombSolver
{
public:
  enum class Method
  {
    newton,     ///< with its fallbacks
    fixed_point ///< alone
  };

  /** @p first_rung leaves out what comes before it in the list above: for tests and measurements. */
  CoulombSolver(const Mprgp::Settings &settings, Method method, unsigned int first_rung = 0);

  /**
   * @p z holds the starting value if it is @p warm, else all points begin closed and stick, and receives
   * the solution or the best that was seen; @p alpha likewise. Converged if `|nu| <= tolerance max(|d|,
   * |S z_0|)` for the projected gradient nu in K(z), in scaled variables as in Mprgp, and the balance
   * holds to 100 times the tolerance in the sense of BalanceSolver. Slipping points have `z_t = +-limit(z_n)`
   * exactly. Never throws for lack of convergence; all work is bounded.
   */
  CoulombReport solve(const ConeProgram &program, dealii::Vector<double> &z,
                      dealii::Vector<double> &alpha, bool warm) const;

  /**
   * `|z' - z|_S / max(|z|_S, |z'|_S)` for the solution @p z and the z' that Newton's method finds from a
   * start that knows nothing of z: all that frictionless contact closes sticks. NaN if it finds none.
   */
  double difference_from_second_start(const ConeProgram &program,
                                      const dealii::Vector<double> &z) const;

private:
  Mprgp::Settings settings;
  Method method;
  unsigned int first_rung;
};
} // namespace hpvi

#endif
