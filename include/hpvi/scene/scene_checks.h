// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_checks_h
#define hpvi_scene_checks_h

#include <hpvi/scene/scene.h>

#include <string>
#include <vector>

namespace hpvi
{
/** Scene::check(). */
void check_scene(const Scene<2> &scene, SceneUse use);

/** Of that the part which functions rely on when they are tried on the body. */
void check_geometry(const Scene<2> &scene);

/** And the part on which the constants of expressions rely. */
void check_materials(const Scene<2> &scene);

/** Scene::free_motions(). */
std::vector<RigidBodyMotion<2>> free_motions(const Scene<2> &scene);

/** What is wrong with a bound where there is no contact, and with a gap where none can open. */
inline const std::string friction_needs_contact =
                             "needs contact; set Contact = bilateral, unilateral or tangential, or "
                             "remove it",
                         gap_needs_contact =
                             "needs contact that can open; set Contact = unilateral or remove it";
} // namespace hpvi

#endif
