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
template <int dim>
class MixedProblem
{
public:
  /** Remembers element matrices from step to step; the scene must outlive this object. */
  explicit MixedProblem(const Scene<dim> &scene);

  /**
   * The solution on the spaces of another one, from which contact starts. @p factor, if there is one, is that of the
   * displacement method on these spaces; it becomes that of this problem. Throws NumericalFailure.
   */
  Solution<dim> solve(const Solution<dim> &start, std::unique_ptr<LinearSolver> &factor);

  /** The last one without what round-off has done to it. Throws NumericalFailure. */
  Solution<dim> correct(const Solution<dim> &solution, const LinearSolver &factor) const;

  const Discretisation<dim> &discretisation() const; ///< of the last solution

private:
  const Scene<dim> &scene;
  const ShapeTables<dim> tables;
  CondensedElements<dim> elements;
  std::unique_ptr<const Discretisation<dim>> last;
};
} // namespace hpvi

#endif
