// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mixed_problem_h
#define hpvi_mixed_problem_h

#include <hpvi/plane/discretisation.h>
#include <hpvi/plane/solution.h>

#include <memory>

namespace hpvi
{
/**
 * The discrete problem on the same spaces by the mixed method with the pair Q_p, P_{p-1} (Volume::projected): near
 * incompressibility u and the pressure `lambda Pi div u` are as near to the solution as with any nu, while the pressure
 * lambda div u_N of the displacement method oscillates. For meshes of parallelograms.
 */
class MixedProblem
{
public:
  /** Remembers element matrices from step to step; the scene must outlive this object. */
  explicit MixedProblem(const Scene<2> &scene);

  /**
   * The solution on the spaces of another one, from which contact starts. @p factor, if there is one, is that of the
   * displacement method on these spaces; it becomes that of this problem. Throws NumericalFailure.
   */
  Solution<2> solve(const Solution<2> &start, std::unique_ptr<LinearSolver> &factor);

  /** The last one without what round-off has done to it. Throws NumericalFailure. */
  Solution<2> correct(const Solution<2> &solution, const LinearSolver &factor) const;

  const Discretisation<2> &discretisation() const; ///< of the last solution

private:
  const Scene<2> &scene;
  const ShapeTables<2> tables;
  CondensedElements<2> elements;
  std::unique_ptr<const Discretisation<2>> last;
};
} // namespace hpvi

#endif
