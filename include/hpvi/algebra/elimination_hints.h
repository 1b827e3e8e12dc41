// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_elimination_hints_h
#define hpvi_elimination_hints_h

#include <vector>

namespace hpvi
{
/** What is known of a matrix without a look at it, by unknown; empty: nothing is. */
struct EliminationHints
{
  std::vector<unsigned int> supervariables; ///< Supervariables::numbers()
  std::vector<unsigned int> stage;          ///< one after the other, of those alike the same
};
} // namespace hpvi

#endif
