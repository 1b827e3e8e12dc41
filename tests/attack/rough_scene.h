// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_attack_rough_scene_h
#define hpvi_attack_rough_scene_h

#include "../metamorphic/random_scene.h"

#include <random>
#include <string>

namespace attack
{
/**
 * A random scene that has a bound of its error, and makes it hard to find: loads, gaps, friction bounds and
 * prescribed displacements that jump, bend, oscillate or are narrow, cells that are long and skew, any method. Friction
 * is Tresca's, or Coulomb's with coefficients from 0.03 to 1.
 */
std::string rough_scene(std::mt19937 &random, bool is_coulomb);
} // namespace attack

#endif
