// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cone_iterate_h
#define hpvi_cone_iterate_h

#include <hpvi/solvers/cone_program.h>
#include <hpvi/solvers/mprgp.h>

#include <limits>

namespace hpvi
{
/** Where an iteration for a ConeProgram stands, and how far from a solution that is. */
class ConeIterate
{
public:
  struct Point
  {
    dealii::Vector<double> z, alpha;
    dealii::Vector<double> r; ///< gradient there
  };

  /** Refers to @p program and @p settings as long as it lives. */
  ConeIterate(const ConeProgram &program, const Mprgp::Settings &settings,
              const dealii::Vector<double> &z, const dealii::Vector<double> &alpha);

  /** `S x - d - G alpha` */
  dealii::Vector<double> gradient(const dealii::Vector<double> &x);

  /** The nearest point of the set without cones to `z - step r`. */
  dealii::Vector<double> target() const;

  /** `L'(e - G'x)`: the gap of the balance in units of energy; empty where there is no balance. */
  dealii::Vector<double> gap(const dealii::Vector<double> &x) const;

  /**
   * The residual of the nearest point in its own set, which is remembered if none was better; a solution
   * where it is not above the tolerance. NaN where the point is not a number.
   */
  double measure();

  /** What Newton's method makes zero: `|z - P(z - step r)|`, and the gap of the balance. */
  double merit() const;

  /** Half of the way back to @p old; the gradient is linear on it. */
  void halve_step(const Point &old);

  const ConeProgram &program;
  const Mprgp::Settings &settings;
  const FrictionCones *set;           ///< the program's, or with less friction
  const dealii::Vector<double> scale; ///< of components, as in Mprgp
  const dealii::FullMatrix<double> L; ///< the root of the penalty
  dealii::Vector<double> step;        ///< the squares of scale
  Point point;
  Point best; ///< nearest to a solution so far, without its gradient
  double residual_of_best = std::numeric_limits<double>::infinity();
  QpReport cost; ///< of all that was done, in the end of the whole run

  static constexpr double balance_noise = 100; ///< tolerance of the balance in units of the other

private:
  double norm(dealii::Vector<double> x) const;
  double sizes_of_terms(const dealii::Vector<double> &x) const;

  const dealii::Vector<double> noise; ///< of z where nothing presses
  double reference = 0;               ///< as in Mprgp
};
} // namespace hpvi

#endif
