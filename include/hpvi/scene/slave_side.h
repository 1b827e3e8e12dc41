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
} // namespace hpvi

#endif
