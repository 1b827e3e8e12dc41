// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_boundary_reader_h
#define hpvi_boundary_reader_h

#include <hpvi/scene/scene.h>

#include <optional>

namespace hpvi
{
class Parameters;

/** Takes all that the section of @p boundary says; @p t is the time in a load history. The body must have been read. */
template <int dim>
void read_boundary(const Parameters &parameters, std::optional<double> t, const Scene<dim> &scene,
                   BoundaryCondition<dim> &boundary);
} // namespace hpvi

#endif
