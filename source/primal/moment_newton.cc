// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/primal/moment_newton.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int maximum_updates = 60; ///< of the augmented Lagrangian

/**
 * From all discs sticking a front of slip advances by a few of them in each step of Newton's method: more than
 * these start with the augmented Lagrangian, whose number of steps does not depend on the mesh.
 */
constexpr unsigned int many_discs = 100;

[[noreturn]] void give_up(const NewtonReport &report)
{
  std::ostringstream line;
  line << "neither Newton's method nor the augmented Lagrangian finds an equilibrium of stick and "
          "slip: after "
       << report.steps << " and " << report.augmented_steps << " steps the residual is "
       << report.residual
       << " of the loads; raise Solver/Primal tolerance, smooth jumps of Friction bound or start "
          "on a coarser mesh";
  throw NumericalFailure(line.str());
}
} // namespace

NewtonReport &NewtonReport::operator+=(const NewtonReport &next)
{
  const NewtonReport before = std::exchange(*this, next);
  steps += before.steps;
  cg_steps += before.cg_steps;
  setups += before.setups;
  line_searches += before.line_searches;
  augmented_steps += before.augmented_steps;
  is_cut_off = is_cut_off || before.is_cut_off;
  return *this;
}

template <int dim>
MomentNewton<dim>::MomentNewton(const MomentSpace<dim> &space, const PrimalSystem<dim> &system,
                                MomentMatrix<dim> &matrix)
    : space(space), system(system), matrix(matrix), c(space.discs.size()), z(space.discs.size()),
      r(space.owned_vector())
{
  for (unsigned int k = 0; k < c.size(); ++k)
    if (acts(k)) // a tenth of the stiffness that a moment meets; its size hardly matters
      c[k] = 0.1 * trace(matrix.block(k)) / (dim - 1) / space.discs[k].radius;
}

template <int dim>
bool MomentNewton<dim>::acts(const unsigned int disc) const
{
  return space.discs[disc].radius > 0;
}

/** r without the forces at discs. */
template <int dim>
DistributedVector MomentNewton<dim>::off_discs() const
{
  DistributedVector result = r;
  for (unsigned int k = 0; k < c.size(); ++k)
    for (unsigned int s = 0; acts(k) && s < dim - 1; ++s)
      result.local_element(space.discs[k].unknowns[s]) = 0;
  return result;
}

/** Of the equations off the discs and of `G (lambda - P(z))`; brings lambda, z and r up to date. */
template <int dim>
typename MomentNewton<dim>::Residual MomentNewton<dim>::residual(const DistributedVector &v,
                                                                 const bool keep_lambda)
{
  DistributedVector product = v;
  matrix.multiply(product, v);
  r = system.f;
  r -= product;
  double on_discs = 0, friction = 0, gap = 0;
  for (unsigned int k = 0; k < c.size(); ++k)
  {
    if (!acts(k))
      continue;
    const double G = space.discs[k].radius;
    const Tangential<dim> m = space.moment(v, k), force = space.moment(r, k);
    if (keep_lambda)
      on_discs += (force - G * lambda[k]).norm_square();
    else
      lambda[k] = force / G;
    z[k] = lambda[k] + c[k] * m;
    on_discs += G * G * (lambda[k] - projected(z[k])).norm_square();
    friction += G * m.norm();
    gap += G * (m.norm() - projected(lambda[k]) * m);
  }
  const std::vector<double> mine{on_discs, friction, gap};
  std::vector<double> sums(mine.size());
  Utilities::MPI::sum(mine, space.communicator(), sums);
  // Not as a difference of norms: forces at discs are so large that their round-off would hide the rest.
  return {std::sqrt(off_discs().norm_sqr() + sums[0]),
          -0.5 * (v * system.f) - 0.5 * (v * r) + sums[1], std::max(0., sums[2])};
}

template <int dim>
std::vector<DiscState<dim>> MomentNewton<dim>::states(const bool all_stick) const
{
  std::vector<DiscState<dim>> result(c.size());
  for (unsigned int k = 0; k < c.size(); ++k)
  {
    const double size = z[k].norm();
    result[k].sticks = acts(k) && (all_stick || size <= 1);
    if (!acts(k) || result[k].sticks)
      continue;
    const Tangential<dim> n = z[k] / size;
    const double stiffness = space.discs[k].radius * c[k] / std::max(size - 1, 1e-9);
    for (unsigned int s = 0; s < dim - 1; ++s)
      for (unsigned int t = 0; t <= s && dim == 3; ++t) // in the plane no direction is left
        result[k].stiffness[s][t] = stiffness * ((s == t ? 1. : 0.) - n[s] * n[t]);
  }
  return result;
}

template <int dim>
DistributedVector
MomentNewton<dim>::right_hand_side(const std::vector<DiscState<dim>> &states) const
{
  DistributedVector b = system.f;
  for (unsigned int k = 0; k < c.size(); ++k)
    if (acts(k) && !states[k].sticks)
      for (unsigned int s = 0; s < dim - 1; ++s)
        b.local_element(space.discs[k].unknowns[s]) -=
            space.discs[k].radius * z[k][s] / z[k].norm();
  return b;
}

template <int dim>
double MomentNewton<dim>::friction(const DistributedVector &v, const DistributedVector &step,
                                   const double length) const
{
  double sum = 0;
  for (unsigned int k = 0; k < c.size(); ++k)
    sum += space.discs[k].radius * (space.moment(v, k) + length * space.moment(step, k)).norm();
  return Utilities::MPI::sum(sum, space.communicator());
}

/** Exact line search from @p old to @p v where the energy, a convex function, rises between them. */
template <int dim>
bool MomentNewton<dim>::shorten(DistributedVector &v, const DistributedVector &old) const
{
  DistributedVector step = v, product = v;
  step -= old;
  matrix.multiply(product, step);
  const double curvature = step * product, slope = -(step * r);
  const double before = friction(old, step, 0);
  const auto rise = [&](const double length)
  {
    return length * slope + 0.5 * length * length * curvature + friction(old, step, length) -
           before;
  };
  if (rise(1) <= 1e-9 * (std::abs(slope) + before))
    return false;
  double begin = 0, end = 1;
  for (unsigned int i = 0; i < 30; ++i)
  {
    const double left = begin + 0.382 * (end - begin), right = begin + 0.618 * (end - begin);
    (rise(left) < rise(right) ? end : begin) = rise(left) < rise(right) ? right : left;
  }
  const double length = std::max(0.5 * (begin + end), 0.02); // to get away from where it is stuck
  v = old;
  v.add(length, step);
  return true;
}

template <int dim>
double MomentNewton<dim>::error(const double gap)
{
  DistributedVector rest = r, correction = r;
  for (unsigned int k = 0; k < c.size(); ++k)
    if (acts(k))
      space.add_moment(rest, k, -space.discs[k].radius * projected(lambda[k]));
  matrix.precondition(correction, rest);
  for (unsigned int k = 0; k < c.size(); ++k) // a disc that stuck until now is none of its unknowns
    if (acts(k) && space.moment(correction, k).norm() == 0)
      space.add_moment(correction, k, space.moment(rest, k) * ((dim - 1) / trace(matrix.block(k))));
  return std::sqrt(std::max(0., rest * correction) + 2 * gap);
}

template <int dim>
unsigned int MomentNewton<dim>::n_slipping(const std::vector<DiscState<dim>> &states) const
{
  unsigned int n = 0;
  for (const DiscState<dim> &state : states)
    n += !state.sticks;
  return Utilities::MPI::sum(n, space.communicator());
}

/** Can the iteration end? Brings the estimated error up to date where it is asked for. */
template <int dim>
bool MomentNewton<dim>::is_exact(const NewtonSettings &settings, const Residual &now,
                                 NewtonReport &report)
{
  const double load = system.f.l2_norm();
  report.residual = load > 0 ? now.norm / load : 0;
  const bool is_small = now.norm <= settings.residual * load;
  const bool knows_error = matrix.n_setups > 0 && (is_small || settings.error > 0);
  report.error = knows_error ? error(now.gap) : 0;
  return is_small || (knows_error && report.error <= settings.error);
}

/** In the place of a Newton step. */
template <int dim>
typename MomentNewton<dim>::Residual MomentNewton<dim>::augment(DistributedVector &v,
                                                                NewtonReport &report)
{
  if (!fallback)
    fallback = std::make_unique<AugmentedLagrangian<dim>>(space, system, matrix, lambda);
  report.augmented_steps += fallback->update(v);
  return residual(v, false);
}

template <int dim>
NewtonReport MomentNewton<dim>::solve(DistributedVector &v, std::vector<Tangential<dim>> &start,
                                      const NewtonSettings &settings,
                                      const std::function<void(const NewtonReport &)> &heard)
{
  const bool warm =
      Utilities::MPI::max(start.size(), space.communicator()) > 0 || space.n_discs == 0;
  lambda = start;
  lambda.resize(c.size());
  for (unsigned int k = 0; warm && k < c.size(); ++k)
    for (const unsigned int unknown : space.discs[k].unknowns)
      if (acts(k) && lambda[k].norm() < 1 - 1e-3)
        v.local_element(unknown) = 0;
  const unsigned int cg_before = matrix.n_steps, setups_before = matrix.n_setups;
  NewtonReport report;
  Residual now = residual(v, warm);
  for (unsigned int updates = 0; !is_exact(settings, now, report);)
  {
    const bool all_stick = !warm && report.steps == 0;
    const auto disc_states = states(all_stick);
    report.n_slipping = n_slipping(disc_states);
    report.cg_steps = matrix.n_steps - cg_before;
    report.setups = matrix.n_setups - setups_before;
    heard(report);
    report.is_cut_off = report.steps >= settings.maximum_steps;
    if (report.is_cut_off || (!warm && space.n_discs > many_discs))
    {
      if (updates++ == maximum_updates)
        give_up(report);
      now = augment(v, report);
      continue;
    }
    matrix.linearise(disc_states);
    const DistributedVector old = v;
    matrix.solve(v, right_hand_side(disc_states),
                 linear_tolerance(settings, now.norm, report.steps));
    if (report.steps > 0 && shorten(v, old))
      ++report.line_searches;
    previous = now.norm;
    ++report.steps;
    now = residual(v, false);
  }
  report.n_slipping = n_slipping(states(false));
  report.cg_steps = matrix.n_steps - cg_before;
  report.setups = matrix.n_setups - setups_before;
  report.fell_back = matrix.fell_back;
  start.resize(c.size());
  for (unsigned int k = 0; k < c.size(); ++k) // feasible: |lambda| = 1 where a disc slips
    start[k] = acts(k) ? projected(z[k]) : Tangential<dim>();
  return report;
}

/** Eisenstat and Walker's rule (1996): the better the last step, the more exact the next. */
template <int dim>
double MomentNewton<dim>::linear_tolerance(const NewtonSettings &settings, const double now,
                                           const unsigned int step) const
{
  const double eta = step == 0 ? 0.1 : std::clamp(0.9 * std::pow(now / previous, 2), 1e-3, 0.1);
  return std::max(eta * now, 0.3 * settings.residual * system.f.l2_norm());
}

template class MomentNewton<2>;
template class MomentNewton<3>;
} // namespace hpvi
