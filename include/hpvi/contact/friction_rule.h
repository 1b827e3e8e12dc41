// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_friction_rule_h
#define hpvi_friction_rule_h

#include <deal.II/base/quadrature_lib.h>

#include <functional>
#include <vector>

namespace hpvi
{
/**
 * The one quadrature rule on [0,1] for everything on a contact edge that holds the friction bound g:
 * a Gauss rule on each of some pieces, with the values of g. A polynomial g of low degree takes one
 * piece, a jump of g is a cut between two.
 */
struct FrictionRule
{
  /** Where g is discontinuous. */
  struct Jump
  {
    double s;      ///< in (0,1), up to round-off
    double height; ///< g behind it minus g before it
  };

  std::vector<double> cuts;                    ///< 0, where pieces meet, 1
  std::vector<double> points, weights, values; ///< of all pieces; values of g
  std::vector<Jump> jumps;

  bool vanishes() const;   ///< is g zero at every point?
  double integral() const; ///< int g
};

/**
 * Cuts [0,1] until @p gauss on a piece gives the same as on its halves and quarters, to 1e-13 of
 * max |g|, for g alone and times polynomials of @p degree >= 1 and one less. What lies between all
 * their points cannot be seen. At most 64 pieces: any g is integrated as well as these can.
 */
FrictionRule make_friction_rule(const std::function<double(double)> &g,
                                const dealii::QGauss<1> &gauss, unsigned int degree);
} // namespace hpvi

#endif
