// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_marking_h
#define hpvi_marking_h

#include <hpvi/driver/stop.h>
#include <hpvi/results/legendre_smoothness.h>
#include <hpvi/results/residual_estimator.h>

#include <functional>
#include <vector>

namespace hpvi
{
/**
 * MARK of the methods of Chapter 5, and of hpa3:
 *
 * | method | rule |
 * |---|---|
 * | hup | bisect every cell |
 * | hap | bisect where `eta_K > hap_threshold * mean(eta_K)` |
 * | pu | raise p everywhere |
 * | hpa1 | by falling eta_K: bisect the first fraction, raise p on the next |
 * | hpa2 | the fraction with the largest eta_K: raise p where `b > hpa2_decay`, else bisect |
 * | hpa3 | where `eta_K > hpa3_threshold * max(eta_K)`: raise p where `b > hpa3_decay`, else bisect |
 *
 * Fractions of n cells are rounded up; cells of equal eta_K come in the order of their index. A
 * cell of maximum degree is bisected where its p would rise, except by pu, which then has nothing
 * left to do. @p eta by active cell.
 */
Refinement mark(const Adaptivity &adaptivity, const Degrees &degrees,
                const std::vector<double> &eta,
                const std::function<double(unsigned int cell)> &decay_rate);

/** That of an entry of Adaptivity for which mark() had no cell to refine. */
Stop nothing_marked(const Adaptivity &adaptivity);
} // namespace hpvi

#endif
