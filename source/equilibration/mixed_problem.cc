// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/schur_complement.h>
#include <hpvi/discretisation/internal_forces.h>
#include <hpvi/discretisation/iterative_refinement.h>
#include <hpvi/discretisation/reduced_problem.h>
#include <hpvi/equilibration/mixed_problem.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * Of the residual of one unknown; errors of N of them are independent, and their work grows like N^{1/2}. Measured: with six times
 * as much some patches are not in balance to 1e-9; to correct everything costs three times the solution.
 */
constexpr double tolerable = 5e-12;

/**
 * How much work the residual of the mixed equations does on the free part of u, relative to its energy.
 */
template <int dim>
double relative_residual(const Discretisation<dim> &discretisation, const Vector<double> &u,
                         const Vector<double> &z)
{
  const Spaces<dim> &spaces = *discretisation.spaces;
  const InternalForces internal = internal_forces(discretisation.scene, spaces.displacement_space,
                                                  *spaces.tables, u, Volume::projected);
  Vector<double> r(discretisation.system.loads()), free(u);
  r -= internal.forces;
  if (z.size() > 0)
    r -= spaces.contact_operator.forces(z);
  const AffineConstraints<double> &constraints = spaces.displacement_space.constraints();
  for (types::global_dof_index dof = 0; dof < free.size(); ++dof)
    if (const auto *entries = constraints.get_constraint_entries(dof))
    {
      free[dof] = 0.; // less what is prescribed
      for (const auto &[master, weight] : *entries)
        free[dof] += weight * u[master];
    }
  return std::abs(r * free) / internal.energy_product;
}
} // namespace

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
  ReducedSolution reduced;
  reduced.z = start.z;
  if (start.z.size() > 0)
    reduced = solve_reduced_problem(*last, schur_complement, Vector<double>(start.z.size()),
                                    std::move(reduced));
  Vector<double> x = schur_complement.displacement(reduced.z);
  if (last->free_motions)
    x += last->free_motions->at_unknowns(reduced.motion);
  Vector<double> u = last->displacement(x);
  if (!(relative_residual(*last, u, reduced.z) <= tolerable * std::sqrt(u.size())))
  {
    AlgebraicError error;
    u = IterativeRefinement<dim>(*last, elements, factor, schur_complement).solve(reduced, error);
  }
  return {scene, start.spaces, std::move(u), std::move(reduced.z)};
}

template <int dim>
const Discretisation<dim> &MixedProblem<dim>::discretisation() const
{
  return *last;
}

template class MixedProblem<2>;
} // namespace hpvi
