// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_collection_h
#define hpvi_collection_h

#include <hpvi/output/record.h>

#include <string>

namespace hpvi
{
/** Name a file in `solution.pvd`, by which ParaView opens all of them; @p time is the step, or the time of a history. */
void add_to_pvd(GrowingText &pvd, double time, const std::string &file);

/** The first @p n_steps steps of what @p pvd has, as if it had no more. */
GrowingText first_of_pvd(const std::string &pvd, unsigned int n_steps);
} // namespace hpvi

#endif
