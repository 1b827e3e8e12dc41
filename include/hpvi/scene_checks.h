// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_checks_h
#define hpvi_scene_checks_h

#include <hpvi/parameters.h>
#include <hpvi/scene.h>

namespace hpvi
{
/** Throws InputError where the supports of two edges contradict each other at their corner. */
void check_corners(const Parameters &parameters, const Scene<2> &scene);

/** Throws InputError where a rigid-body motion stays free: the stiffness matrix were singular. */
void check_supports(const Scene<2> &scene);

/**
 * Throws InputError where the scene's data or its friction law contradict its exact solution, so
 * that an error against that solution is an error of the method.
 */
void check_exact_solution(const Parameters &parameters, const Scene<2> &scene);
} // namespace hpvi

#endif
