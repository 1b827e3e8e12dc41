// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_coarse_solver_h
#define hpvi_coarse_solver_h

#include <hpvi/algebra/linear_solver.h>
#include <hpvi/space/multigrid_level.h>

namespace hpvi
{
/** `(A + H)^-1` on the coarsest mesh by a sparse factorisation, the same on every process. */
class CoarseSolver
{
public:
  using Vector = MultigridLevel<float>::Vector;

  /** @p level must outlive it. Collective. */
  explicit CoarseSolver(const MultigridLevel<float> &level);

  /** With the states of the level. Collective. Throws NumericalFailure where the matrix is not positive. */
  void factor();

  void solve(Vector &x, const Vector &b) const; ///< collective

private:
  std::size_t entry(unsigned int row, unsigned int column) const;

  const MultigridLevel<float> &level;
  SymmetricMatrix A; ///< with rows of the unit matrix where unknowns are constrained
  std::unique_ptr<LinearSolver> solver;
};
} // namespace hpvi

#endif
