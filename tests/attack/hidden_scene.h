// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_attack_hidden_scene_h
#define hpvi_attack_hidden_scene_h

#include "drawn_scene.h"

#include <random>
#include <string>
#include <vector>

namespace attack
{
/**
 * What hidden_scene() draws: narrow strips of initial strain, temperature and gaps; of springs; friction bounds that are narrow
 * near a held corner; springs beside joints of two to six bodies; four bodies around a vertex; rigid plates with probes on and beside
 * them.
 */
extern const std::vector<std::string> hidden_kinds;

/**
 * A random scene of that kind in cells that are far larger than what acts on them. The generator knows where that is:
 * lines of the reference's mesh meet the edges of each strip, or its cells get small towards the place, and tied bodies
 * are one there.
 */
DrawnScene hidden_scene(const std::string &kind, std::mt19937 &random);
} // namespace attack

#endif
