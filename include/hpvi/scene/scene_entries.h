// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_entries_h
#define hpvi_scene_entries_h

#include <hpvi/scene/parameters.h>

#include <string>
#include <vector>

namespace hpvi
{
/** By boundary id. */
inline const std::vector<std::string> boundary_names = {"left", "right", "bottom",
                                                        "top",  "front", "back"};

/** In the order of the enumerators of Method. */
inline const std::vector<std::string> method_names = {"hup2", "hup3", "hup4", "hap2", "hap3",
                                                      "hap4", "pu",   "hpa1", "hpa2", "hpa3"};

/**
 * All entries of a scene file in the order in which they are printed: names, defaults, admissible
 * values and documentation.
 */
std::vector<Entry> scene_entries(int dim);
} // namespace hpvi

#endif
