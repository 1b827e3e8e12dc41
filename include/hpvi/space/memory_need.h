// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_memory_need_h
#define hpvi_memory_need_h

#include <hpvi/space/moment_space.h>

#include <string>

namespace hpvi
{
/** What a machine that has the memory for the matrix of @p space should know before all of it is taken. Collective. */
template <int dim>
std::string memory_note(const MomentSpace<dim> &space);

/** Throws NumericalFailure on all processes where those of one machine need more than it has. Collective. */
template <int dim>
void require_room(const MomentSpace<dim> &space);
} // namespace hpvi

#endif
