// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_plate_report_h
#define hpvi_plate_report_h

#include <hpvi/results/equilibrium.h>

#include <string>

namespace hpvi
{
/** How the rigid plate on @p boundary moves and turns, the end of a line; empty where there is none. */
template <int dim>
std::string plate_in_words(const Scene<dim> &scene, const std::string &boundary,
                           const Equilibrium<dim> &equilibrium);

/** Of each plate its mean point, how that moves and turns, and the moment about it: an object of JSON. */
template <int dim>
std::string plates_json(const Scene<dim> &scene, const Equilibrium<dim> &equilibrium);
} // namespace hpvi

#endif
