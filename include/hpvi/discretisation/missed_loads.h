// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_missed_loads_h
#define hpvi_missed_loads_h

#include <hpvi/discretisation/discretisation.h>
#include <hpvi/discretisation/solution.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * Where the loads of the mesh have another resultant than those of the coarse one, something narrow lay between all samples of
 * @p loads: in words, with both forces; else empty.
 */
std::string missed_loads(const Discretisation<2> &discretisation, const LoadRules<2> &loads);

/**
 * Where the stiffness of springs on an edge by its rule and by one of twice as many points are not the same to 1e-9 of the largest, in
 * words: the equations hold for other springs than the scene's there, and no bound tells how far these are. Else empty.
 */
std::string unresolved_springs(const Solution<2> &solution);

/** The worst of those that rules do not resolve, in words; empty: there is none. */
std::string unresolved_loads(const std::vector<UnresolvedLoad<2>> &unresolved,
                             const LoadRules<2> &loads);
} // namespace hpvi

#endif
