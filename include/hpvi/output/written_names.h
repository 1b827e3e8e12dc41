// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_written_names_h
#define hpvi_written_names_h

#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/** Of the files that a run of @p scene writes, as the ResultDirectory wants them. */
template <int dim>
std::string names_written(const Scene<dim> &scene, unsigned int n_processes);
} // namespace hpvi

#endif
