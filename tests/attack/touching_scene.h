// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_attack_touching_scene_h
#define hpvi_attack_touching_scene_h

#include <random>
#include <string>

namespace attack
{
/**
 * A random scene of two or three boxes on each other in any frame, whose meshes match or are nested where @p matches: glued, sliding,
 * pressed or rubbing, with gaps, loads and friction bounds that vary, materials up to a thousand times as stiff, any method.
 */
std::string touching_scene(std::mt19937 &random, bool matches);
} // namespace attack

#endif
