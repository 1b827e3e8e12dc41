// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_probe_reader_h
#define hpvi_probe_reader_h

#include <hpvi/scene/scene.h>

#include <string>
#include <vector>

namespace hpvi
{
class Parameters;
struct Entry;

/** The entries of `Probe NAME`. */
std::vector<Entry> probe_entries(int dim, const std::string &name);

/** Takes the probes called @p names; the boundaries of @p scene must be there. */
template <int dim>
void read_probes(const Parameters &parameters, const std::vector<std::string> &names,
                 Scene<dim> &scene);
} // namespace hpvi

#endif
