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

/**
 * The largest magnitudes of what @p scene prescribes, at points all over its body and boundaries, and of
 * Scene::past_data. Either stands for the other: a stress strains the body over its whole size, and a
 * displacement stresses it. Bounds of friction and gaps that are open drive nothing and do not count.
 */
template <int dim>
DataScale data_scale(const Scene<dim> &scene);

/** Tractions and displacements below this part of data_scale() are round-off of the data. */
constexpr double round_off_of_data = 1e-12;

/** Two conditions on a displacement that differ by no more agree [length]. */
template <int dim>
double support_tolerance(const Scene<dim> &scene);

/**
 * The scene of load step @p number of the history of @p scene, after load steps whose data are @p past. Values of
 * loads, prescribed displacements and gaps that are round-off beside the data so far, as of `sin(pi*t)` for t = 1,
 * are 0, and so is what is too small to be squared.
 */
template <int dim>
Scene<dim> load_step(const Scene<dim> &scene, unsigned int number, const DataScale &past);

/** What is wrong with a bound where there is no contact, and with a gap where none can open. */
inline const std::string friction_needs_contact =
                             "needs contact; set Contact = bilateral, unilateral or tangential, or "
                             "remove it",
                         gap_needs_contact =
                             "needs contact that can open; set Contact = unilateral or remove it";
} // namespace hpvi

#endif
