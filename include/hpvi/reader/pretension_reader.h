// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_pretension_reader_h
#define hpvi_pretension_reader_h

#include <hpvi/scene/scene.h>

#include <string>
#include <vector>

namespace hpvi
{
class Parameters;
struct Entry;

/** The entries of `Pretension NAME`. */
std::vector<Entry> pretension_entries(const std::string &name);

/** `Pretension NAME` */
std::string section_of_pretension(const std::string &name);

/** Gives @p body, if it is a box, the grid lines of the cuts called @p names. */
void cut_at_pretensions(const Parameters &parameters, const std::vector<std::string> &names,
                        Scene<2> &body);

/** Takes the cuts called @p names; the body, its parts and materials must be there. */
void read_pretensions(const Parameters &parameters, const std::vector<std::string> &names,
                      Scene<2> &scene);
} // namespace hpvi

#endif
