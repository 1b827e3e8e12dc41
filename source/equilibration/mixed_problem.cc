// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/schur_complement.h>
#include <hpvi/discretisation/iterative_refinement.h>
#include <hpvi/equilibration/mixed_problem.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

template <int dim>
MixedProblem<dim>::MixedProblem(const Scene<dim> &scene)
    : scene(scene), elements(scene, tables, Volume::projected)
{
}

template <int dim>
Solution<dim> MixedProblem<dim>::solve(const Solution<dim> &start)
{
  // The previous one goes last: it keeps the element matrices that the new one shares.
  last = std::make_unique<const Discretisation<dim>>(scene, start.spaces, elements);
  const LinearSolver factor = last->factor();
  const SchurComplement schur_complement(factor, last->system.f, last->contact_rows);
  // Errors of N unknowns are independent, and their work grows like N^{1/2}. Measured: with six times as much some
  // patches are not in balance to 1e-9; to correct everything costs three times the solution.
  const double tolerance = std::max(1e-10, 5e-12 * std::sqrt(start.u.size()));
  ReducedSolution reduced;
  reduced.z = start.z;
  AlgebraicError error;
  Vector<double> u = IterativeRefinement<dim>(*last, elements, factor, schur_complement, tolerance)
                         .solve(reduced, error);
  return {scene, start.spaces, std::move(u), std::move(reduced.z)};
}

template <int dim>
const Discretisation<dim> &MixedProblem<dim>::discretisation() const
{
  return *last;
}

template class MixedProblem<2>;
} // namespace hpvi
