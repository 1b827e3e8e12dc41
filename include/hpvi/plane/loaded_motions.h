// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_loaded_motions_h
#define hpvi_loaded_motions_h

#include <hpvi/plane/discretisation.h>
#include <hpvi/plane/resistance.h>

namespace hpvi
{
/**
 * The free motions of a scene that contact alone holds and the loads along them: those that contact sees first; of the
 * others a load that nothing resists is more than round-off.
 */
template <int dim>
LoadedMotions<dim> loaded_motions(const Discretisation<dim> &discretisation);
} // namespace hpvi

#endif
