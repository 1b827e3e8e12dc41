// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_metamorphic_fibres_h
#define hpvi_metamorphic_fibres_h

#include "frame.h"

#include <string>
#include <utility>
#include <vector>

namespace metamorphic
{
/** What makes a material orthotropic; moduli over E2, which is the `young` of its material. */
struct Fibres
{
  double E1 = 1, E3 = 1, nu12 = 0, nu13 = 0, nu23 = 0, G12 = 0.5, angle = 0; ///< [degrees]
};

/** Elastic in both planes, with E1 up to @p ratio. */
Fibres random_fibres(double ratio, std::mt19937 &random);

/** The entries of the material in @p frame: it turns and mirrors the axes, and scales moduli. */
std::vector<std::pair<std::string, std::string>> entries(const Fibres &fibres, double young,
                                                         const Frame &frame);
} // namespace metamorphic

#endif
