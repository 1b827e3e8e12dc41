// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_aliases_h
#define hpvi_scene_aliases_h

#include <hpvi/reader/input/parameters.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * For names that are not among scene_entries(): what users of other programs write first. Paths of entries stand in quotes.
 * @p interfaces: curves inside of bodies.
 */
std::vector<Alias> scene_aliases(int dim, const std::vector<std::string> &boundaries,
                                 const std::vector<std::string> &interfaces = {});
} // namespace hpvi

#endif
