// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_attack_curved_scene_h
#define hpvi_attack_curved_scene_h

#include <random>
#include <string>

namespace attack
{
/**
 * A random scene of contact along curves: a disc on a plane, a block or another disc, a ring in a rigid seat or in another ring whose mesh does
 * not match, with gaps, friction bounds and loads that vary, materials up to a hundred times as stiff. Degrees are 7 and more, so that the
 * bodies of two meshes, whose edges are polynomials, are the same to less than bounds are apart.
 */
std::string curved_scene(std::mt19937 &random);

/** The same of bodies of revolution off their axis: rings, and straight tubes with loads of all kinds. */
std::string turned_scene(std::mt19937 &random);
} // namespace attack

#endif
