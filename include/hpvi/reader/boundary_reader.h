// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_boundary_reader_h
#define hpvi_boundary_reader_h

#include <hpvi/scene/scene.h>

#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
class Parameters;
struct Entry;

/** The entries of `Boundary NAME`. */
std::vector<Entry> boundary_entries(const std::string &boundary);

/** What a part of a side has beside these. */
std::vector<Entry> part_entries(const std::string &part, const std::vector<std::string> &sides);

/** `Wear coefficient` of a boundary or a pair. */
Entry wear_entry(const std::string &section);

/** Its value; throws InputError where nothing @p slides, or there is no load history. */
double read_wear(const Parameters &parameters, const std::string &section, bool slides);

/** Is the entry named with more than what it is where nobody names it, as scene.prm names all? */
bool says_something(const Parameters &parameters, const std::string &section,
                    const std::string &entry);

/** Takes all that the section of @p boundary says; @p t is the time in a load history. The body must have been read. */
template <int dim>
void read_boundary(const Parameters &parameters, std::optional<double> t, const Scene<dim> &scene,
                   BoundaryCondition<dim> &boundary);
} // namespace hpvi

#endif
