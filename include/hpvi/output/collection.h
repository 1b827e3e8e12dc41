// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_collection_h
#define hpvi_collection_h

#include <hpvi/output/record.h>

#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** Name a file in `solution.pvd` or `contact.pvd`, by which ParaView opens all of them; @p time is the step, or the time of a history. */
void add_to_pvd(GrowingText &pvd, double time, const std::string &file);

/**
 * Of the files of a step those that ParaView opens, each with the name of its collection: of a solution on several processes the file
 * that names the pieces.
 */
std::vector<std::pair<std::string, std::string>> collected(const std::vector<std::string> &files);

/** The first @p n_steps steps of what @p pvd has, as if it had no more. */
GrowingText first_of_pvd(const std::string &pvd, unsigned int n_steps);
} // namespace hpvi

#endif
