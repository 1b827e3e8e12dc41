// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_json_h
#define hpvi_scene_json_h

#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/**
 * What `scene.json` says of a scene, for whoever draws it: title, units, the words of `hpvi --validate`, which entries are not at
 * their defaults; parts of the boundary with their supports, contact, gaps and loads at points along them, body force, probes; in the plane
 * outlines of the coarse cells and pretensions, in space faces of these along the boundary. Of a load history what it is at its end, t = 1. Throws InputError where an
 * expression has no value.
 */
template <int dim>
std::string scene_json(const Scene<dim> &scene);
} // namespace hpvi

#endif
