// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_elimination_h
#define hpvi_elimination_h

#include <cholmod.h>
#include <hpvi/algebra/elimination_hints.h>

#include <vector>

namespace hpvi
{
/**
 * In which order unknowns are eliminated, and where the factor has entries: found by CHOLMOD for one of all unknowns that
 * are alike (Supervariables), which stand one after the other. Constrained AMD takes stage by stage and those kept last; many unknowns
 * of which none is kept and no stage is known are dissected by METIS.
 */
class Elimination
{
public:
  /**
   * @p A: the upper triangle; @p interface: ascending, with all that are alike or none of them; they come after all stages. Whether it
   * succeeded is in @p common.
   */
  Elimination(const cholmod_sparse &A, const EliminationHints &hints,
              const std::vector<unsigned int> &interface, cholmod_common &common);

  std::vector<int> permutation; ///< position in the factorisation -> number of the unknown

  /** The supernodes of L, without numbers. Null: it failed, @p common says why. */
  cholmod_factor *analyse(cholmod_common &common);

private:
  void gather(const cholmod_sparse &A, const std::vector<unsigned int> &supervariables);
  void order(const std::vector<unsigned int> &stage, const std::vector<unsigned int> &interface,
             cholmod_common &common);
  void expand();
  cholmod_sparse as_cholmod();

  unsigned int n_classes = 0;
  std::vector<int> first, member;     ///< unknowns by class: where a class begins, its unknowns
  std::vector<int> column_start, row; ///< the upper triangle of the classes' matrix
  std::vector<int> class_order;       ///< position -> class
  std::vector<int> start;             ///< position of a class -> that of its first unknown
};
} // namespace hpvi

#endif
