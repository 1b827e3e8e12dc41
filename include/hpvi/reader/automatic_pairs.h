// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_automatic_pairs_h
#define hpvi_automatic_pairs_h

#include <hpvi/base/parameter_file.h>
#include <hpvi/scene/scene.h>

#include <string>
#include <vector>

namespace hpvi
{
/** Names of the pairs that say `Between = automatic`. */
std::vector<std::string> automatic_pairs(const std::vector<Assignment> &all);

/** @p all without the sections of @p pairs. */
std::vector<Assignment> without_pairs(const std::vector<Assignment> &all,
                                      const std::vector<std::string> &pairs);

/**
 * @p all with a section of its own for all sides of @p bodies, which has no such pairs, that lie on each other, in the place of each
 * automatic one, and with what that says; @p sections are these as text. Throws InputError where there are none.
 */
template <int dim>
std::vector<Assignment> with_pairs_found(const std::vector<Assignment> &all,
                                         const std::vector<std::string> &pairs,
                                         const Scene<dim> &bodies, std::string &sections);
} // namespace hpvi

#endif
