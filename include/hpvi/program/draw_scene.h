// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_draw_scene_h
#define hpvi_draw_scene_h

#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/** `hpvi --picture`: scene_picture() as scene.svg into @p directory, and where it is. Throws InputError or OutputFailure. */
void draw_scene(const Scene<2> &scene, const std::string &directory);
} // namespace hpvi

#endif
