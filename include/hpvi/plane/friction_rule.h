// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_friction_rule_h
#define hpvi_friction_rule_h

#include <hpvi/algebra/cut_rule.h>

namespace hpvi
{
/**
 * The one quadrature rule on [0,1] for everything on a contact edge that holds the friction bound g, or the
 * coefficient in its place, with the values of g.
 */
using FrictionRule = CutRule;

/**
 * Cuts [0,1] until @p gauss on a piece gives the same as on its halves, its quarters and parts of at
 * most 1/@p n_parts, to 1e-13 of max |g|, for g alone and times polynomials of @p degree >= 1 and one less. What
 * lies between all their points cannot be seen: with three points or more and 16 parts it is narrower than 1/40.
 */
FrictionRule make_friction_rule(const std::function<double(double)> &g,
                                const dealii::QGauss<1> &gauss, unsigned int degree,
                                unsigned int n_parts = 16);
} // namespace hpvi

#endif
