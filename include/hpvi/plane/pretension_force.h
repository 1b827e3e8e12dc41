// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_pretension_force_h
#define hpvi_pretension_force_h

#include <hpvi/plane/solution.h>

#include <vector>

namespace hpvi
{
/**
 * The tension across each cut of Scene::pretensions, `int sigma_N : E + int f . n psi` over its layer, for unit thickness
 * [stress length^(dim-1)]: the derivative of the energy by the shortening.
 */
std::vector<double> pretension_forces(const Solution<2> &solution);
} // namespace hpvi

#endif
