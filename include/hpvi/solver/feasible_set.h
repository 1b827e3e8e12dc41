// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_feasible_set_h
#define hpvi_feasible_set_h

#include <deal.II/lac/vector.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * A product of intervals, half lines and discs, one after the other over the components of z:
 *
 *     l_i <= z_i <= u_i,                          sides may be infinite,
 *     (z_i^2 + z_{i+1}^2)^{1/2} <= radius,        a disc takes two components.
 *
 * Every question that an algorithm may ask about the constraint set is answered here, so that
 * solvers know nothing of its shape.
 */
class FeasibleSet
{
public:
  FeasibleSet() = default;

  /** Intervals alone. Throws where add_interval() would. */
  FeasibleSet(const dealii::Vector<double> &lower, const dealii::Vector<double> &upper);

  /** Throws unless `lower <= upper`; a lower side of +infinity is no side, nor is an upper of -infinity. */
  void add_interval(double lower, double upper);

  /** Throws unless `radius >= 0`. */
  void add_disc(double radius);

  unsigned int size() const; ///< number of components

  double lower_side(unsigned int i) const; ///< of an interval, -infinity where there is none
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
   * feasible. Zero on the rim of a disc unless p leads into it.
   */
  double distance_to_wall(const dealii::Vector<double> &z, const dealii::Vector<double> &p) const;

  /**
   * Split the gradient `r = S z - d` at z into free part phi (5.9) and chopped part beta (5.8) of
   * the thesis; their sum is the projected gradient nu (5.10), which vanishes at the minimiser:
   *
   *     phi_i = r_i          where l_i < z_i < u_i,   else 0,
   *     beta_i = min(r_i, 0) where z_i = l_i,  max(r_i, 0) where z_i = u_i,   else 0,
   *
   * and both are 0 where l_i = u_i. Inside a disc phi = r; on its rim with outer normal n
   * `beta = r - min(n.r, 0) n`. NaN in r stays NaN where l_i < u_i.
   */
  void split_gradient(const dealii::Vector<double> &z, const dealii::Vector<double> &r,
                      dealii::Vector<double> &phi, dealii::Vector<double> &beta) const;

  /** One direction in which a component, or two of a disc, may still move. */
  struct Direction
  {
    unsigned int first;            ///< component
    unsigned int size;             ///< 1, or 2 along the rim of a disc
    std::array<double, 2> weights; ///< unit vector
    double curvature; ///< what the rim adds to the second derivative of q in this direction
  };

  /** The set as Newton's method sees it from one point. */
  struct Linearisation
  {
    /** By interval or half of a disc: -1 at the lower side, 1 at the upper or on the rim, 0 free. */
    std::vector<signed char> walls;
    dealii::Vector<double> base;       ///< the point, with what is held on its walls
    std::vector<Direction> directions; ///< in which r = 0 is asked for
    bool curved = false;               ///< does the base lie on the rim of a disc?
  };

  /**
   * Predict from z and the gradient r what is held: where `z - step r` leaves the set (step > 0 by
   * component, equal within a disc), a wall holds; the rim of a disc leaves the direction along it, in
   * which it adds `-n.r / radius` to the curvature of q.
   */
  Linearisation linearise(const dealii::Vector<double> &z, const dealii::Vector<double> &r,
                          const dealii::Vector<double> &step) const;

  /** Make factors of components equal within a disc: the smaller of the two. */
  void make_isotropic(dealii::Vector<double> &scale) const;

  /**
   * The set in the variables `y_i = z_i / scale_i`, scale_i > 0, equal within a disc. A wall goes
   * exactly to a wall: the sides are divided just as a caller divides z.
   */
  FeasibleSet scaled(const dealii::Vector<double> &scale) const;

  /** `z_i = scale_i y_i`, where a wall of scaled(scale) becomes that wall exactly. */
  void unscale(const dealii::Vector<double> &y, const dealii::Vector<double> &scale,
               dealii::Vector<double> &z) const;

private:
  struct Disc
  {
    unsigned int first;
    double radius;
  };

  std::vector<double> lower, upper; ///< infinite for the components of discs
  std::vector<Disc> discs;
};
} // namespace hpvi

#endif
