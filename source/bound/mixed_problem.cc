// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/schur_complement.h>
#include <hpvi/bound/mixed_problem.h>
#include <hpvi/plane/iterative_refinement.h>

namespace hpvi
{
using namespace dealii;

MixedProblem::MixedProblem(const Scene<2> &scene)
    : scene(scene), elements(scene, tables, Volume::projected)
{
}

Solution<2> MixedProblem::solve(const Solution<2> &start, std::unique_ptr<LinearSolver> &factor)
{
  // The previous one goes last: it keeps the element matrices that the new one shares.
  last = std::make_unique<const Discretisation<2>>(scene, start.spaces, elements);
  if (factor)
    last->factor(*factor);
  else
    factor = std::make_unique<LinearSolver>(last->factor());
  ReducedSolution reduced;
  reduced.z = start.z;
  const SchurComplement schur_complement(*factor, last->system.f, last->contact_rows);
  Vector<double> u =
      IterativeRefinement<2>(*last, elements, *factor, schur_complement).uncorrected(reduced);
  return {scene, start.spaces, std::move(u), std::move(reduced.z)};
}

Solution<2> MixedProblem::correct(const Solution<2> &solution, const LinearSolver &factor) const
{
  ReducedSolution reduced;
  reduced.z = solution.z;
  AlgebraicError error;
  const SchurComplement schur_complement(factor, last->system.f, last->contact_rows);
  Vector<double> u = IterativeRefinement<2>(*last, elements, factor, schur_complement)
                         .solve(reduced, error, /*is_suspect=*/true);
  return {scene, solution.spaces, std::move(u), std::move(reduced.z)};
}

const Discretisation<2> &MixedProblem::discretisation() const
{
  return *last;
}
} // namespace hpvi
