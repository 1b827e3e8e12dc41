// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_picture_h
#define hpvi_scene_picture_h

#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/**
 * What a scene says, as scalable vector graphics: the body with its coarse mesh, supports, loads, contact, materials in
 * colour, names and sizes with units. Of a load history what it is at its end, t = 1.
 */
std::string scene_picture(const Scene<2> &scene);
} // namespace hpvi

#endif
