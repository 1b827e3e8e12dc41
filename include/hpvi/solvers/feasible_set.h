// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_feasible_set_h
#define hpvi_feasible_set_h

#include <deal.II/lac/vector.h>
#include <hpvi/base/numbers.h>

#include <vector>

namespace hpvi
{
/**
 * A product of intervals and half lines, one for each component of z: `l_i <= z_i <= u_i`, where sides may be
 * infinite.
 *
 * Every question that an algorithm may ask about the constraint set is answered here, so that
 * solvers know nothing of its shape.
 */
class FeasibleSet
{
public:
  FeasibleSet() = default;

  /** Throws where add_interval() would. */
  FeasibleSet(const dealii::Vector<double> &lower, const dealii::Vector<double> &upper);

  /** Throws unless `lower <= upper`; a lower side of +infinity is no side, nor is an upper of -infinity. */
  void add_interval(double lower, double upper);

  unsigned int size() const; ///< number of components

  double lower_side(unsigned int i) const; ///< -infinity where there is none
  double upper_side(unsigned int i) const;

  /** z := the nearest point of the set; NaN stays NaN. */
  void project(dealii::Vector<double> &z) const;

  /**
   * z := a point of the set with the largest product with @p direction. Where that has no end z is a
   * direction that leads there, one component of size 1 in each unbounded interval, and the result is
   * false.
   */
  bool farthest(const dealii::Vector<double> &direction, dealii::Vector<double> &z) const;

  /**
   * Largest alpha >= 0 with `z - alpha p` in the set (infinity if no wall is met). z must be
   * feasible.
   */
  double distance_to_wall(const dealii::Vector<double> &z, const dealii::Vector<double> &p) const;

  /**
   * Split the gradient `r = S z - d` at z into free part phi (5.9) and chopped part beta (5.8) of
   * the thesis; their sum is the projected gradient nu (5.10), which vanishes at the minimiser:
   *
   *     phi_i = r_i          where l_i < z_i < u_i,   else 0,
   *     beta_i = min(r_i, 0) where z_i = l_i,  max(r_i, 0) where z_i = u_i,   else 0,
   *
   * and both are 0 where l_i = u_i. NaN in r stays NaN where l_i < u_i.
   */
  void split_gradient(const dealii::Vector<double> &z, const dealii::Vector<double> &r,
                      dealii::Vector<double> &phi, dealii::Vector<double> &beta) const;

  /** The set as Newton's method sees it from one point. */
  struct Linearisation
  {
    std::vector<signed char> walls; ///< -1 at the lower side, 1 at the upper, 0 free
    dealii::Vector<double> base;    ///< the point, with what is held on its walls
    std::vector<unsigned int> free; ///< components for which r = 0 is asked for
  };

  /** Predict from z and the gradient r what is held: where `z - step r` leaves the set, step > 0 by component. */
  Linearisation linearise(const dealii::Vector<double> &z, const dealii::Vector<double> &r,
                          const dealii::Vector<double> &step) const;

  /**
   * The set in the variables `y_i = z_i / scale_i`, scale_i > 0. A wall goes
   * exactly to a wall: the sides are divided just as a caller divides z.
   */
  FeasibleSet scaled(const dealii::Vector<double> &scale) const;

  /** `z_i = scale_i y_i`, where a wall of scaled(scale) becomes that wall exactly. */
  void unscale(const dealii::Vector<double> &y, const dealii::Vector<double> &scale,
               dealii::Vector<double> &z) const;

private:
  std::vector<double> lower, upper;
};
} // namespace hpvi

#endif
