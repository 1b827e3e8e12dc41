// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cut_rule_h
#define hpvi_cut_rule_h

#include <deal.II/base/quadrature_lib.h>

#include <functional>
#include <vector>

namespace hpvi
{
/**
 * A quadrature rule on [0,1] for a function f: a Gauss rule on each of some pieces, with the values of f. A
 * polynomial of low degree takes one piece, a jump is a cut between two.
 */
struct CutRule
{
  /** Where f is discontinuous. */
  struct Jump
  {
    double s;      ///< in (0,1), up to round-off
    double height; ///< f behind it minus f before it
  };

  std::vector<double> cuts;                    ///< 0, where pieces meet, 1
  std::vector<double> points, weights, values; ///< of all pieces; values of f
  std::vector<Jump> jumps;
  double finer_integral = 0; ///< int f by the finest parts of all pieces, four times finer or more
  double deviation = 0; ///< sum over pieces of what an integral with f differs by on finer parts
  double worst = 0.5;   ///< the middle of the piece with the largest of these

  bool vanishes() const;   ///< is f zero at every point?
  double integral() const; ///< int f
};

/**
 * Cuts [0,1] until @p gauss on a piece gives the same as on its halves and quarters, and on @p n_parts of [0,1],
 * to 1e-13 of max |f|, for f times Legendre polynomials of the degrees @p factors, of which some should be even and
 * some odd. What lies between all their points cannot be seen. At most 64 pieces: any f is integrated as well as
 * these can, and `deviation` tells how well.
 */
CutRule make_cut_rule(const std::function<double(double)> &f, const dealii::QGauss<1> &gauss,
                      const std::vector<unsigned int> &factors, unsigned int n_parts = 4);
} // namespace hpvi

#endif
