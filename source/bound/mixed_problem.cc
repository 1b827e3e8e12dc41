// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/schur_complement.h>
#include <hpvi/bound/mixed_problem.h>
#include <hpvi/plane/iterative_refinement.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
MixedProblem<dim>::MixedProblem(const Scene<dim> &scene)
    : scene(scene), elements(scene, tables, Volume::projected)
{
}

template <int dim>
Solution<dim> MixedProblem<dim>::solve(const Solution<dim> &start,
                                       std::unique_ptr<LinearSolver> &factor)
{
  // The previous one goes last: it keeps the element matrices that the new one shares.
  last = std::make_unique<const Discretisation<dim>>(scene, start.spaces, elements);
  if (factor)
    last->factor(*factor);
  else
    factor = std::make_unique<LinearSolver>(last->factor());
  ReducedSolution reduced;
  reduced.z = start.z;
  const SchurComplement schur_complement(*factor, last->system.f, last->contact_rows);
  Vector<double> u =
      IterativeRefinement<dim>(*last, elements, *factor, schur_complement).uncorrected(reduced);
  return {scene, start.spaces, std::move(u), std::move(reduced.z)};
}

template <int dim>
Solution<dim> MixedProblem<dim>::correct(const Solution<dim> &solution,
                                         const LinearSolver &factor) const
{
  ReducedSolution reduced;
  reduced.z = solution.z;
  AlgebraicError error;
  const SchurComplement schur_complement(factor, last->system.f, last->contact_rows);
  Vector<double> u = IterativeRefinement<dim>(*last, elements, factor, schur_complement)
                         .solve(reduced, error, /*is_suspect=*/true);
  return {scene, solution.spaces, std::move(u), std::move(reduced.z)};
}

template <int dim>
const Discretisation<dim> &MixedProblem<dim>::discretisation() const
{
  return *last;
}

template class MixedProblem<2>;
} // namespace hpvi
