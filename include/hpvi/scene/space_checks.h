// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_space_checks_h
#define hpvi_space_checks_h

#include <hpvi/scene/scene.h>

#include <vector>

namespace hpvi
{
/** Scene::check() in space. */
void check_scene(const Scene<3> &scene, SceneUse use);

/** Of that the part which functions rely on when they are tried on the body. */
void check_geometry(const Scene<3> &scene);

/** And the part on which the constants of expressions rely. */
void check_materials(const Scene<3> &scene);

/**
 * Scene::free_motions(): none. Throws InputError where the supports leave one, which no contact may
 * resist in space.
 */
std::vector<RigidBodyMotion<3>> free_motions(const Scene<3> &scene);

/** Throws InputError where @p scene asks for what the primal path does not offer. */
template <int dim>
void check_primal_path(const Scene<dim> &scene);
} // namespace hpvi

#endif
