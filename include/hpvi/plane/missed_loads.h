// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_missed_loads_h
#define hpvi_missed_loads_h

#include <hpvi/plane/discretisation.h>
#include <hpvi/plane/solution.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * Where loads, stresses of initial strains or springs of the mesh have another sum than those of the coarse one, something narrow lay between all samples of
 * @p loads: in words, with both sums; else empty.
 */
std::string missed_loads(const Discretisation<2> &discretisation, const LoadRules<2> &loads);

/** The worst of those that rules do not resolve, in words; empty: there is none. */
std::string unresolved_loads(const std::vector<UnresolvedLoad<2>> &unresolved);

/** Its components, in brackets. */
std::string in_words(Datum datum, const DatumValue &value);
} // namespace hpvi

#endif
