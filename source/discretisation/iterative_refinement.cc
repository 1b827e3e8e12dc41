// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/discretisation/internal_forces.h>
#include <hpvi/discretisation/iterative_refinement.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A sum whose bits do not depend on the number of threads, unlike deal.II's product. */
double dot(const Vector<double> &a, const Vector<double> &b)
{
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
}
} // namespace

template <int dim>
IterativeRefinement<dim>::IterativeRefinement(const Scene<dim> &scene,
                                              const DisplacementSpace<dim> &space,
                                              const ContactSpace<dim> &contact_space,
                                              const ShapeTables<dim> &tables,
                                              const ElasticSystem<dim> &system,
                                              const ElementStiffnesses<dim> &stiffnesses,
                                              const SchurComplement &schur_complement)
    : scene(scene), space(space), contact_space(contact_space), tables(tables), system(system),
      stiffnesses(stiffnesses), schur_complement(schur_complement)
{
}

template <int dim>
Vector<double> IterativeRefinement<dim>::solve(Reduction &reduction, AlgebraicError &error) const
{
  Vector<double> u, defect(contact_space.n_multipliers()), last;
  for (unsigned int passes_left = 10;; --passes_left)
  {
    if (defect.size() > 0)
      reduction = solve_reduced_problem(scene, contact_space, system, schur_complement, defect,
                                        std::move(reduction));
    Vector<double> x = schur_complement.displacement(reduction.lambda);
    if (scene.free_translation())
      x.add(reduction.translation, system.translation);
    u = system.recover(x);
    error = improve(reduction.lambda, u);
    if (error.corrections == 0 || defect.size() == 0)
      return u;
    if (last.size() > 0)
    {
      last -= reduction.lambda;
      error.multiplier = last.linfty_norm();
      if (error.multiplier <= 1e-9 || passes_left == 1)
        return u;
    }
    last = reduction.lambda;
    defect += system.tangential_moments(u);
    defect -= reduction.moments;
  }
}

/** `f - B' lambda - A u` for every displacement unknown; at supports that is minus their reaction. */
template <int dim>
Vector<double> IterativeRefinement<dim>::residual(const Vector<double> &lambda,
                                                  const Vector<double> &u,
                                                  double &energy_product) const
{
  const InternalForces internal = internal_forces(scene, space, tables, u);
  energy_product = internal.energy_product;
  Vector<double> r(system.loads());
  r -= internal.forces;
  if (lambda.size() > 0)
    r -= system.friction_forces(lambda);
  return r;
}

/**
 * A bound of the energy that the last bits of u have: 100 times `mu (epsilon |u|)^2` for each unknown. A
 * body with no more is moved, not strained. The stiffest material has most.
 */
template <int dim>
double IterativeRefinement<dim>::round_off_energy(const Vector<double> &u) const
{
  const double last_bit = std::numeric_limits<double>::epsilon() * u.linfty_norm();
  return 100 * scene.largest_mu() * last_bit * last_bit * u.size();
}

/** Does the residual do more work on the free part of u than round-off explains? */
template <int dim>
bool IterativeRefinement<dim>::contradicts(const Vector<double> &r, const Vector<double> &u,
                                           const double energy_product) const
{
  const AffineConstraints<double> &constraints = space.constraints();
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
AlgebraicError IterativeRefinement<dim>::improve(const Vector<double> &lambda,
                                                 Vector<double> &u) const
{
  AlgebraicError error;
  Vector<double> r = residual(lambda, u, error.energy_product);
  if (!(error.energy_product > round_off_energy(u)) || !contradicts(r, u, error.energy_product))
    return error;

  const auto interiors = system.interiors(stiffnesses);
  const auto precondition = [&](const Vector<double> &forces)
  { return system.respond(schur_complement.solve(system.reduce(forces)), forces, interiors); };
  Vector<double> z = precondition(r), p(z), best(u);
  double square = dot(r, z), least = square;
  const double exact = 1e-28 * error.energy_product;
  const unsigned int most = 60, patience = 6;
  for (unsigned int stalled = 0; least > exact && stalled < patience && error.corrections < most;
       ++error.corrections)
  {
    const double curvature = internal_forces(scene, space, tables, p).energy_product;
    if (!(curvature > 0.))
      break;
    u.add(dot(r, p) / curvature, p);
    // Always the true residual: the recursion of conjugate gradients would follow its own round-off.
    double energy_product;
    r = residual(lambda, u, energy_product);
    z = precondition(r);
    const double last = square;
    square = dot(r, z);
    p.sadd(square / last, z);
    stalled = square < 0.25 * least ? 0 : stalled + 1;
    if (square < least)
    {
      least = square;
      best = u;
      error.energy_product = energy_product;
    }
  }
  u = best;
  error.relative = std::sqrt(least / error.energy_product);
  return error;
}

template class IterativeRefinement<2>;
} // namespace hpvi
