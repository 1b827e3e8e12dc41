// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_pair_rules_h
#define hpvi_pair_rules_h

#include <hpvi/reader/input/parameters.h>
#include <hpvi/scene/expression.h>

#include <array>
#include <optional>
#include <string>

namespace hpvi
{
/** The two sides that `Between` names. */
std::array<std::string, 2> read_between(const Parameters &parameters, const std::string &section);

/** Which of @p sides is `Slave`; null: automatic. Sides @p of_one_body are no pair. */
std::optional<unsigned int> read_slave(const Parameters &parameters, const std::string &section,
                                       const std::array<std::string, 2> &sides, bool of_one_body);

/** The number of `Closed within` of a pair of bodies of @p size, and a hair for round-off of distances [length]. */
double read_closed_within(const Parameters &parameters, const std::string &section, double size);

/** What counts as none of distances of @p sides from @p least to @p largest, negative where they lie inside each other. */
std::string closed_in_words(const std::string &section, const std::array<std::string, 2> &sides,
                            double closed, double least, double largest);

/** @p distance, but 0 up to @p closed and to the depth @p doubt. */
template <int dim>
Expression<dim> beyond(double closed, double doubt, const Expression<dim> &distance);

[[noreturn]] void reject_overlap(const Parameters &parameters, const std::string &section,
                                 double depth, const std::string &place);

/** A side of which a part hangs over the end of the other is the master: a multiplier would press there where nobody is. */
void choose_slave(const Parameters &parameters, const std::string &section,
                  const std::array<bool, 2> &hangs_over, std::optional<unsigned int> &slave);
} // namespace hpvi

#endif
