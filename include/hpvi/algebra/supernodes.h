// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_supernodes_h
#define hpvi_supernodes_h

#include <cholmod.h>

#include <optional>
#include <vector>

namespace hpvi
{
/** Supernodes of a factor by what can be done at once. */
struct SharedSupernodes
{
  std::vector<std::vector<int>> subtrees; ///< of the elimination tree, from below, the root last
  std::vector<std::vector<int>>
      above; ///< all others: those that have none above a subtree below them, those above these ...
};

/**
 * The numbers of the supernodal factor L of a matrix whose lower triangle @p A is in the order of L, columns that CHOLMOD has analysed: L
 * holds none so far, or those of another matrix. Subtrees of the elimination tree by all threads of the thread pool; of what is above them, those
 * that are not above one another, and each in panels of columns. Parts and sums do not depend on the number of threads, and nor does a bit.
 * Returns nothing where A is not positive definite.
 */
std::optional<SharedSupernodes> factor_supernodes(const cholmod_sparse &A, cholmod_factor &L);
} // namespace hpvi

#endif
