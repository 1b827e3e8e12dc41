// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_pressure_neighbourhoods_h
#define hpvi_pressure_neighbourhoods_h

#include <hpvi/bound/pressed_face.h>

#include <map>

namespace hpvi
{
/**
 * Sets t of faces, by their number along the boundary, so that no pressure is negative: those on which z_n is share
 * a quadratic program with a neighbourhood that grows until there is a solution. @p scale: the largest pressure. False: a
 * face has no admissible pressure.
 */
bool press(std::map<unsigned int, PressedFace> &faces, double scale);
} // namespace hpvi

#endif
