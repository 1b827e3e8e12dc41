// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_zones_h
#define hpvi_contact_zones_h

#include <hpvi/results/contact_state.h>
#include <hpvi/scene/scene.h>

namespace hpvi
{
/** Finds transitions and zones of @p state, whose boundary is @p side, from its points: of all of them, in order. */
void find_zones(const Scene<2> &scene, const Side<2> &side, ContactState<2> &state);
} // namespace hpvi

#endif
