// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_claim_h
#define hpvi_claim_h

#include <string>
#include <vector>

namespace hpvi
{
/** A guaranteed interval of one number of the exact solution, which another step, or the other side of a pair, may know as well. */
struct Claim
{
  std::string what, where; ///< as in "the least energy", "in step 2"
  double low, high;        ///< `low <= number <= high`
  double round_off;        ///< by which the ends may be off
};

using Claims = std::vector<Claim>;

/**
 * Claims of one number have a number in common, for the exact solution is in all of them. Two that have none in words, one of them of
 * @p now and the other of @p now or @p earlier, and those farthest from each other; empty: all meet.
 */
std::string contradiction(const Claims &earlier, const Claims &now);
} // namespace hpvi

#endif
