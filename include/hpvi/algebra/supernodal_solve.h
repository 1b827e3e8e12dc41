// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_supernodal_solve_h
#define hpvi_supernodal_solve_h

#include <hpvi/algebra/supernodes.h>

namespace hpvi
{
/**
 * `x := L^-1 x` with the numbers that factor_supernodes() has set, x in the order of L: subtrees by all threads of the thread pool, then what is above
 * them. What subtrees add to the rest is added in their order, so that no bit depends on the number of threads.
 */
void solve_forward(const cholmod_factor &L, const SharedSupernodes &shared, double *x);

/** `x := L^-T x`, likewise, from above. */
void solve_backward(const cholmod_factor &L, const SharedSupernodes &shared, double *x);
} // namespace hpvi

#endif
