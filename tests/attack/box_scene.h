// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_attack_box_scene_h
#define hpvi_attack_box_scene_h

#include <random>
#include <string>

namespace attack
{
/**
 * A random box in space that has a bound of its error: one or two materials, cells of any shape up to 1:3, loads, gaps and friction
 * bounds that are polynomials, oscillate or bend, and any of the methods.
 */
std::string box_scene(std::mt19937 &random);
} // namespace attack

#endif
