// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_checks_h
#define hpvi_scene_checks_h

#include <hpvi/scene/parameters.h>
#include <hpvi/scene/scene.h>

#include <optional>

namespace hpvi
{
/** Throws InputError where the supports of two edges contradict each other at their corner. */
void check_corners(const Parameters &parameters, const Scene<2> &scene);

/**
 * The direction in which supports and contact leave the body free to move and friction alone
 * resists (a semicoercive problem), if there is one. Throws InputError where nothing resists.
 */
std::optional<dealii::Tensor<1, 2>> free_translation(const Scene<2> &scene);

/**
 * Throws InputError where the scene's data or its friction law contradict its exact solution, so
 * that an error against that solution is an error of the method.
 */
void check_exact_solution(const Parameters &parameters, const Scene<2> &scene);

/**
 * Throws InputError where the multiplier on a contact edge had a negative degree, and, unless the
 * inf-sup constant is only to be measured, where it had degree p or more.
 */
void check_multiplier_degree(const Parameters &parameters, const Scene<2> &scene, SceneUse use);

/**
 * Throws InputError where the coarse mesh alone has more free displacement unknowns than
 * Adaptivity/Maximum unknowns, before memory is spent on it.
 */
void check_first_step(const Parameters &parameters, const Scene<2> &scene);
} // namespace hpvi

#endif
