// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/plane/internal_forces.h>
#include <hpvi/plane/iterative_refinement.h>
#include <hpvi/plane/negligible_solution.h>
#include <hpvi/scene/data_scale.h>

#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

template <int dim>
IterativeRefinement<dim>::IterativeRefinement(const Discretisation<dim> &discretisation,
                                              const CondensedElements<dim> &elements,
                                              const LinearSolver &solver,
                                              const SchurComplement &schur_complement)
    : discretisation(discretisation), elements(elements), solver(solver),
      schur_complement(schur_complement)
{
}

template <int dim>
Vector<double> IterativeRefinement<dim>::uncorrected(ReducedSolution &reduced) const
{
  Vector<double> defect(discretisation.spaces->contact_space.n_multipliers());
  if (defect.size() > 0)
    reduced = solve_reduced_problem(discretisation, schur_complement, defect, std::move(reduced));
  Vector<double> x = schur_complement.displacement(reduced.z);
  if (discretisation.free_motions)
    x += discretisation.free_motions->at_unknowns(reduced.motion);
  return discretisation.displacement(x);
}

template <int dim>
Vector<double> IterativeRefinement<dim>::solve(ReducedSolution &reduced, AlgebraicError &error,
                                               const bool is_suspect) const
{
  const ContactSpace<dim> &contact_space = discretisation.spaces->contact_space;
  Vector<double> u = uncorrected(reduced), defect(contact_space.n_multipliers());
  error = improve(reduced.z, u, is_suspect);
  if (error.corrections == 0 || defect.size() == 0)
    return u;
  for (unsigned int passes_left = 9; passes_left > 0; --passes_left)
  {
    defect += discretisation.spaces->contact_operator.moments(u);
    for (unsigned int i = 0; i < defect.size(); ++i)
      defect[i] -= contact_space.multipliers()[i].gap + reduced.moments[i];
    const ReducedSolution last = reduced;
    reduced = solve_reduced_problem(discretisation, schur_complement, defect, std::move(reduced));
    u += displacement_between(last, reduced);
    const unsigned int corrections = error.corrections;
    error = improve(reduced.z, u, /*is_suspect=*/true);
    error.corrections += corrections;
    Vector<double> change(reduced.z);
    change -= last.z;
    const double largest = std::max(contact_space.largest_bound(), reduced.z.linfty_norm());
    error.multiplier = change.linfty_norm() == 0. ? 0. : change.linfty_norm() / largest;
    if (change.linfty_norm() <=
        std::max(1e-9 * largest, round_off_of_data * discretisation.scene.past_data.stress))
      break;
  }
  return u;
}

/** What the difference of two solutions of the reduced problem does to u: its round-off is that of the difference. */
template <int dim>
Vector<double> IterativeRefinement<dim>::displacement_between(const ReducedSolution &from,
                                                              const ReducedSolution &to) const
{
  Vector<double> z(to.z);
  z -= from.z;
  Vector<double> x = schur_complement.response(z);
  if (discretisation.free_motions)
  {
    Vector<double> motion(to.motion);
    motion -= from.motion;
    x += discretisation.free_motions->at_unknowns(motion);
  }
  Vector<double> result = discretisation.unknowns.expand(x);
  discretisation.condensation.extend(result);
  return result;
}

/** `f - B' z - A u` for every displacement unknown; at supports that is minus their reaction. */
template <int dim>
Vector<double> IterativeRefinement<dim>::residual(const Vector<double> &z, const Vector<double> &u,
                                                  double &energy_product) const
{
  const Spaces<dim> &spaces = *discretisation.spaces;
  const InternalForces internal = internal_forces(discretisation.scene, spaces.displacement_space,
                                                  *spaces.tables, u, elements.volume());
  energy_product = internal.energy_product;
  Vector<double> r(discretisation.system.loads());
  r -= internal.forces;
  if (z.size() > 0)
    r -= spaces.contact_operator.forces(z);
  return r;
}

/**
 * A bound of the energy that the last bits of u have, or of what the data displace: 100 times `weight (epsilon |u|)^2`
 * for each unknown. A body with no more is moved, not strained, and so is one with none beside load steps before. The stiffest
 * material has most.
 */
template <int dim>
double IterativeRefinement<dim>::round_off_energy(const Vector<double> &u) const
{
  const double largest = std::max(u.linfty_norm(), data_scale(discretisation.scene).displacement),
               last_bit = std::numeric_limits<double>::epsilon() * largest;
  return std::max(100 * discretisation.scene.largest_weight() * last_bit * last_bit * u.size(),
                  negligible_energy(discretisation.scene));
}

/** Does the residual do more work on the free part of u than round-off explains? */
template <int dim>
bool IterativeRefinement<dim>::contradicts(const Vector<double> &r, const Vector<double> &u,
                                           const double energy_product) const
{
  const AffineConstraints<double> &constraints =
      discretisation.spaces->displacement_space.constraints();
  double work = 0;
  for (types::global_dof_index dof = 0; dof < r.size(); ++dof)
    if (const auto *entries = constraints.get_constraint_entries(dof))
      for (const auto &[master, weight] : *entries)
        work += r[dof] * weight * u[master];
    else
      work += r[dof] * u[dof];
  return !(std::abs(work) <= 1e-10 * energy_product);
}

template <int dim>
AlgebraicError IterativeRefinement<dim>::improve(const Vector<double> &z, Vector<double> &u,
                                                 const bool is_suspect) const
{
  AlgebraicError error;
  Vector<double> r = residual(z, u, error.energy_product);
  if (!(error.energy_product > round_off_energy(u)) ||
      !(is_suspect || contradicts(r, u, error.energy_product)))
    return error;

  const Unknowns<dim> &unknowns = discretisation.unknowns;
  const Condensation<dim> &condensation = discretisation.condensation;
  const auto interiors = condensation.interiors(elements);
  // A^-1 r: condensed, solved, and extended into the cells again.
  const auto precondition = [&](const Vector<double> &forces)
  {
    Vector<double> on_boundary(forces);
    condensation.eliminate(on_boundary);
    Vector<double> answer = unknowns.expand(solver.solve(unknowns.collect(on_boundary)));
    condensation.extend(answer);
    condensation.add_interior(forces, interiors, answer);
    return answer;
  };
  Vector<double> answer = precondition(r), p(answer), best(u);
  double square = dot(r, answer), least = square;
  // Far from the solution a step may gain nothing and the next one much; near it that is round-off.
  const auto patience = [&] { return least > 1e-20 * error.energy_product ? 6U : 1U; };
  const double enough =
      std::max(1e-24 * error.energy_product, negligible_energy(discretisation.scene));
  const unsigned int most = 60;
  for (unsigned int stalled = 0; least > enough && stalled < patience() && error.corrections < most;
       ++error.corrections)
  {
    const double curvature =
        internal_forces(discretisation.scene, discretisation.spaces->displacement_space,
                        *discretisation.spaces->tables, p, elements.volume())
            .energy_product;
    if (!(curvature > 0.))
      break;
    u.add(dot(r, p) / curvature, p);
    // Always the true residual: the recursion of conjugate gradients would follow its own round-off.
    double energy_product;
    r = residual(z, u, energy_product);
    answer = precondition(r);
    const double last = square;
    square = dot(r, answer);
    p.sadd(square / last, answer);
    stalled = square < 0.25 * least ? 0 : stalled + 1;
    if (square < least)
    {
      least = square;
      best = u;
      error.energy_product = energy_product;
    }
  }
  u = best;
  // What is left of a body that is only moved is round-off, of which there is no part.
  if (error.energy_product > round_off_energy(u))
    error.relative = std::sqrt(least / error.energy_product);
  return error;
}

template class IterativeRefinement<2>;
} // namespace hpvi
