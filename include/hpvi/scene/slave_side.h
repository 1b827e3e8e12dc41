// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_slave_side_h
#define hpvi_slave_side_h

#include <hpvi/scene/scene.h>

namespace hpvi
{
/**
 * Which of the two parts of a pair in space has the multipliers, on all meshes: what `Slave` names, else that of the softer body
 * along the contact, and where the moduli differ by less than a factor of 3 that with more faces. On a stiff slave multigrid
 * takes the more steps the stiffer it is: its coarse meshes do not know what the jumps of a fine one cost.
 */
unsigned int slave_of(const Scene<3> &scene, const ContactPair &pair);

/** By boundary id: is it a part of a pair that has no multipliers? */
std::vector<bool> masters_of(const Scene<3> &scene);

/** By number of the pair: is any cell at one of both sides of second order? */
std::vector<bool> curved_pairs(const Scene<3> &scene);

/**
 * By boundary id: may its faces lie opposite to a slave? Those of masters; in a curved pair all of that side that have no multipliers, for
 * along normals that turn faces are seen that see nothing themselves.
 */
std::vector<bool> opposite_boundaries(const Scene<3> &scene);
} // namespace hpvi

#endif
