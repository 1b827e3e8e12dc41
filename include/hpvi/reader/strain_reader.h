// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_strain_reader_h
#define hpvi_strain_reader_h

#include <hpvi/scene/scene.h>

#include <optional>

namespace hpvi
{
class Parameters;

/** Takes initial strains and the temperature of all materials; @p t is the time in a load history. */
void read_initial_strains(const Parameters &parameters, std::optional<double> t, Scene<2> &scene);
} // namespace hpvi

#endif
