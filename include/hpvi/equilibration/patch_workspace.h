// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_patch_workspace_h
#define hpvi_patch_workspace_h

#include <hpvi/equilibration/equilibration_cache.h>

#include <array>
#include <vector>

namespace hpvi
{
/** One component of the traction on an edge as data of a cell: `r_row += weight R t`. */
struct TractionBlock
{
  unsigned int row;                    ///< among the data of the edges
  unsigned int n;                      ///< coefficients
  double weight;                       ///< of the component in the direction of the data
  const dealii::FullMatrix<double> *R; ///< to a half of the edge; null: the whole
  unsigned int unknown;                ///< the first, or none
  const std::vector<double> *known;    ///< coefficients, where there is no unknown
};

/**
 * The memory that a patch needs while it is solved. There are thousands with a few dozen unknowns each, so that asking for it
 * takes as long as the arithmetic: each thread keeps its own from patch to patch.
 */
struct PatchWorkspace
{
  std::vector<std::array<unsigned int, 2>> first_unknown; ///< by edge of the patch and component
  std::vector<std::vector<TractionBlock>> blocks;         ///< by cell
  EquilibrationCache::Signature signature;
  std::vector<double> g, right, mu, met;
  std::vector<double> known, changed_gradient, changed_defect; ///< of one cell
};
} // namespace hpvi

#endif
