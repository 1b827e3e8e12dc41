// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/space/semismooth_newton.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * The least |z| - 1 in H, which is then at most a hundred times A: on pairs of meshes that do not match, multigrid takes 420 steps instead
 * of 20 where discs have 1e-6 here.
 */
constexpr double edge = 1e-3;
// Of the error that Newton's method may leave, in its first step; then a tenth in each step.
constexpr double linear_part = 0.1;
constexpr unsigned int maximum_updates = 60; ///< of the augmented Lagrangian

/**
 * From all contact dofs held a front of slip or of open contact advances by a few of them in each step of Newton's method:
 * in the plane more than these start with the augmented Lagrangian, whose number of steps does not depend on the mesh. In
 * space it advances in two directions, and 4096 contact dofs take eight steps where the augmented Lagrangian takes forty.
 */
template <int dim>
constexpr unsigned int many_moments = dim == 2 ? 100 : numbers::invalid_unsigned_int;

/** Of the largest internal forces so far: loads that are smaller are no size to compare a residual with. */
constexpr double least_load = 1e-3;

/** Of the residual two steps before: one that has not fallen below goes to and fro between two sets of states. */
constexpr double to_and_fro = 0.9;

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
  tresca_problems += before.tresca_problems;
  contraction = std::max(contraction, before.contraction);
  cg_steps += before.cg_steps;
  setups += before.setups;
  line_searches += before.line_searches;
  augmented_steps += before.augmented_steps;
  is_cut_off = is_cut_off || before.is_cut_off;
  return *this;
}

template <int dim>
SemismoothNewton<dim>::SemismoothNewton(const PrimalSpace<dim> &space,
                                        const PrimalSystem<dim> &system, NewtonMatrix<dim> &matrix)
    : space(space), system(system), matrix(matrix), c(space.contact.size()),
      z(space.contact.size()), r(space.owned_vector())
{
  std::vector<double> own;
  for (const ContactDof<dim> &contact_dof : space.contact)
    own.push_back(contact_dof.weight);
  take_weights(own);
}

template <int dim>
void SemismoothNewton<dim>::take_weights(const std::vector<double> &new_weights)
{
  weights = new_weights;
  fallback.reset(); // which has other ones
  for (unsigned int k = 0; k < c.size(); ++k)
    if (acts(k)) // a tenth of the stiffness that a contact dof meets; its size hardly matters
      c[k] = 0.1 * stiffness(k) / weights[k];
}

template <int dim>
bool SemismoothNewton<dim>::acts(const unsigned int k) const
{
  return weights[k] > 0;
}

/** What a contact dof meets in A, the mean of its directions. */
template <int dim>
double SemismoothNewton<dim>::stiffness(const unsigned int k) const
{
  return trace(matrix.block(k)) / (dim - 1);
}

/** m - u_0 */
template <int dim>
ContactVector<dim> SemismoothNewton<dim>::distance(const DistributedVector &v,
                                                   const unsigned int k) const
{
  return space.contact_value(v, k) - space.contact[k].gap;
}

/**
 * A multiplier in its set. Of a pressure P(z) and not P(lambda): where contact is open the residual would make
 * a pressure of either sign, and its product with the distance would be taken for an error.
 */
template <int dim>
ContactVector<dim> SemismoothNewton<dim>::admissible(const unsigned int k) const
{
  const ContactDof<dim> &contact_dof = space.contact[k];
  return contact_dof.projected(contact_dof.is_friction() ? lambda[k] : z[k]);
}

/** What is missing to the equality of both energies, and the price of penetration. */
template <int dim>
double SemismoothNewton<dim>::gap(const DistributedVector &v, const unsigned int k) const
{
  const ContactDof<dim> &contact_dof = space.contact[k];
  const ContactVector<dim> m = distance(v, k);
  if (contact_dof.is_friction())
    return weights[k] * (m.norm() - admissible(k) * m);
  const double depth =
      contact_dof.kind == ContactDof<dim>::Kind::pressure ? std::max(0., m[0]) : m.norm();
  return weights[k] * std::abs(admissible(k) * m) + 0.5 * stiffness(k) * depth * depth;
}

/** r without the forces of the contact. */
template <int dim>
DistributedVector SemismoothNewton<dim>::off_contact() const
{
  DistributedVector result = r;
  for (unsigned int k = 0; k < c.size(); ++k)
    if (acts(k))
      space.set_contact_value(result, k, {});
  return result;
}

/** Of the equations off the contact and of `G (lambda - P(z))`; brings lambda, z and r up to date. */
template <int dim>
typename SemismoothNewton<dim>::Residual SemismoothNewton<dim>::residual(const DistributedVector &v,
                                                                         const bool keep_lambda)
{
  DistributedVector product = v;
  matrix.multiply(product, v);
  internal = std::max(internal, product.l2_norm());
  r = system.f;
  r -= product;
  double on_contact = 0, gaps = 0, forces = 0;
  for (unsigned int k = 0; k < c.size(); ++k)
  {
    if (!acts(k))
      continue;
    const ContactDof<dim> &contact_dof = space.contact[k];
    const double G = weights[k];
    const ContactVector<dim> force = space.contact_value(r, k);
    if (keep_lambda)
      on_contact += (force - G * lambda[k]).norm_square();
    else
      lambda[k] = force / G;
    z[k] = lambda[k] + c[k] * distance(v, k);
    on_contact += G * G * (lambda[k] - contact_dof.projected(z[k])).norm_square();
    forces += contact_dof.is_friction() ? 0. : G * G * contact_dof.projected(z[k]).norm_square();
    gaps += gap(v, k);
  }
  const std::vector<double> mine{on_contact, gaps, forces};
  std::vector<double> sums(mine.size());
  Utilities::MPI::sum(mine, space.communicator(), sums);
  return {std::sqrt(off_contact().norm_sqr() + sums[0]), std::max(0., sums[1]),
          std::max({system.f.l2_norm(), std::sqrt(sums[2]), least_load * internal})};
}

template <int dim>
std::vector<ContactDofState<dim>> SemismoothNewton<dim>::states(const bool all_held) const
{
  std::vector<ContactDofState<dim>> result(c.size());
  for (unsigned int k = 0; k < c.size(); ++k)
  {
    const ContactDof<dim> &contact_dof = space.contact[k];
    result[k].is_held = acts(k) && (all_held || contact_dof.holds(z[k]));
    if (!acts(k) || result[k].is_held || !contact_dof.is_friction())
      continue;
    const double size = z[k].norm();
    const ContactVector<dim> n = z[k] / size;
    const double H = weights[k] * c[k] / std::max(size - 1, edge);
    for (unsigned int s = 0; s < dim - 1; ++s)
      for (unsigned int t = 0; t <= s && dim == 3; ++t) // in the plane no direction is left
        result[k].stiffness[s][t] = H * ((s == t ? 1. : 0.) - n[s] * n[t]);
  }
  return result;
}

/** Where contact dofs are held: 0, or the gap. */
template <int dim>
void SemismoothNewton<dim>::hold(DistributedVector &v,
                                 const std::vector<ContactDofState<dim>> &states) const
{
  for (unsigned int k = 0; k < c.size(); ++k)
    if (states[k].is_held)
      space.set_contact_value(v, k, space.contact[k].gap);
}

/**
 * With P(z) = z/|z| where a disc slips, whose stiffness acts from u_0 on, and 0 where contact is open; what is held has no
 * equation.
 */
template <int dim>
DistributedVector
SemismoothNewton<dim>::right_hand_side(const std::vector<ContactDofState<dim>> &states) const
{
  DistributedVector b = system.f;
  for (unsigned int k = 0; k < c.size(); ++k)
    space.add_contact_value(b, k,
                            states[k].stiffness * space.contact[k].gap -
                                weights[k] * space.contact[k].projected(z[k]));
  return b;
}

/** Deeper than round-off beside @p force? */
template <int dim>
bool SemismoothNewton<dim>::penetrates(const DistributedVector &v, const double force) const
{
  double deepest = 0;
  for (unsigned int k = 0; k < c.size(); ++k)
    if (space.contact[k].kind == ContactDof<dim>::Kind::pressure)
      deepest = std::max(deepest, stiffness(k) * distance(v, k)[0]);
  return Utilities::MPI::max(deepest, space.communicator()) > 1e-10 * force;
}

template <int dim>
double SemismoothNewton<dim>::friction(const DistributedVector &v, const DistributedVector &step,
                                       const double length) const
{
  double sum = 0;
  for (unsigned int k = 0; k < c.size(); ++k)
    if (const ContactDof<dim> &contact_dof = space.contact[k]; contact_dof.is_friction())
      sum += weights[k] * (distance(v, k) + length * space.contact_value(step, k)).norm();
  return Utilities::MPI::sum(sum, space.communicator());
}

/** Exact line search from @p old to @p v where the energy, a convex function, rises between them. */
template <int dim>
bool SemismoothNewton<dim>::shorten(DistributedVector &v, const DistributedVector &old,
                                    const double load) const
{
  if (space.n_pressures > 0 && (penetrates(old, load) || penetrates(v, load)))
    return false;
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
double SemismoothNewton<dim>::error(const double gap)
{
  DistributedVector rest = r, correction = r;
  for (unsigned int k = 0; k < c.size(); ++k)
    if (acts(k))
      space.add_contact_value(rest, k, -weights[k] * admissible(k));
  matrix.precondition(correction, rest);
  for (unsigned int k = 0; k < c.size(); ++k) // what was held until now is none of its unknowns
    if (acts(k) && space.contact_value(correction, k).norm() == 0)
      space.add_contact_value(correction, k, space.contact_value(rest, k) / stiffness(k));
  return std::sqrt(std::max(0., rest * correction) + 2 * gap);
}

template <int dim>
void SemismoothNewton<dim>::count(const std::vector<ContactDofState<dim>> &states,
                                  NewtonReport &report) const
{
  unsigned int slipping = 0, pressing = 0;
  for (const ContactDofFace<dim> &face : space.faces)
    for (unsigned int k = 0; k < space.tables.of(face.cell).n_contact_dofs(); ++k)
    {
      const bool presses = face.has_pressure() && states[face.pressure + k].is_held;
      pressing += presses;
      if (space.condition(face.cell, face.face).friction &&
          (presses || !face.has_pressure())) // else it is open
        slipping += !states[face.friction + k].is_held;
    }
  report.n_slipping = Utilities::MPI::sum(slipping, space.communicator());
  report.n_pressing = Utilities::MPI::sum(pressing, space.communicator());
}

/** Can the iteration end? Brings the estimated error up to date where it is asked for. */
template <int dim>
bool SemismoothNewton<dim>::is_exact(const NewtonSettings &settings, const Residual &now,
                                     NewtonReport &report)
{
  report.residual = now.load > 0 ? now.norm / now.load : 0;
  const bool is_small = now.norm <= settings.residual * now.load;
  const bool knows_error =
      matrix.n_setups > 0 && ((is_small && settings.wants_error) || settings.error > 0);
  report.error = knows_error ? error(now.gap) : 0;
  return is_small || (knows_error && report.error <= settings.error);
}

/** In the place of a Newton step. */
template <int dim>
typename SemismoothNewton<dim>::Residual SemismoothNewton<dim>::augment(DistributedVector &v,
                                                                        NewtonReport &report)
{
  if (!fallback)
    fallback = std::make_unique<AugmentedLagrangian<dim>>(space, system, matrix, weights, lambda);
  report.augmented_steps += fallback->update(v);
  return residual(v, false);
}

template <int dim>
NewtonReport SemismoothNewton<dim>::solve(DistributedVector &v,
                                          std::vector<ContactVector<dim>> &start,
                                          const NewtonSettings &settings,
                                          const std::function<void(const NewtonReport &)> &heard)
{
  const bool warm =
      Utilities::MPI::max(start.size(), space.communicator()) > 0 || space.n_multipliers() == 0;
  lambda = start;
  lambda.resize(c.size());
  for (unsigned int k = 0; warm && k < c.size(); ++k)
    if (const ContactDof<dim> &contact_dof = space.contact[k];
        acts(k) &&
        (contact_dof.is_friction() ? lambda[k].norm() < 1 - 1e-3 : contact_dof.holds(lambda[k])))
      space.set_contact_value(v, k, contact_dof.gap);
  const unsigned int cg_before = matrix.n_steps, setups_before = matrix.n_setups;
  NewtonReport report;
  Residual now = residual(v, warm);
  for (unsigned int updates = 0; !is_exact(settings, now, report);)
  {
    const bool all_held = !warm && report.steps == 0;
    const auto moment_states = states(all_held);
    count(moment_states, report);
    report.cg_steps = matrix.n_steps - cg_before;
    report.setups = matrix.n_setups - setups_before;
    heard(report);
    report.is_cut_off = report.steps >= settings.maximum_steps;
    if (report.is_cut_off || (!warm && space.n_discs + space.n_pressures > many_moments<dim>))
    {
      if (updates++ == maximum_updates)
        give_up(report);
      now = augment(v, report);
      continue;
    }
    matrix.linearise(moment_states);
    const DistributedVector old = v;
    hold(v, moment_states);
    matrix.solve(v, right_hand_side(moment_states), linear_tolerance(settings, now, report.steps),
                 linear_part * std::pow(0.1, report.steps) * settings.error);
    if (report.steps > 0 && shorten(v, old, now.load))
      ++report.line_searches;
    const double two_before = std::exchange(previous, now.norm);
    ++report.steps;
    now = residual(v, false);
    if (report.steps > 1 &&
        now.norm > to_and_fro * two_before) // half way from set to set is in none
    {
      v.sadd(0.5, 0.5, old);
      now = residual(v, false);
      ++report.line_searches;
    }
  }
  count(states(false), report);
  report.cg_steps = matrix.n_steps - cg_before;
  report.setups = matrix.n_setups - setups_before;
  report.fell_back = matrix.fell_back;
  report.linear = matrix.method;
  start.resize(c.size());
  for (unsigned int k = 0; k < c.size();
       ++k) // feasible: |lambda| = 1 where a disc slips, 0 where contact is open
    start[k] = acts(k) ? space.contact[k].projected(z[k]) : ContactVector<dim>();
  return report;
}

template <int dim>
NewtonReport SemismoothNewton<dim>::measure(const DistributedVector &v,
                                            const std::vector<ContactVector<dim>> &where,
                                            const NewtonSettings &settings)
{
  NewtonReport report;
  lambda = where;
  is_exact(settings, residual(v, true), report);
  count(states(false), report);
  return report;
}

/** Eisenstat and Walker's rule (1996): the better the last step, the more exact the next. */
template <int dim>
double SemismoothNewton<dim>::linear_tolerance(const NewtonSettings &settings, const Residual &now,
                                               const unsigned int step) const
{
  const double eta =
      step == 0 ? 0.1 : std::clamp(0.9 * std::pow(now.norm / previous, 2), 1e-3, 0.1);
  return std::max(eta * now.norm, 0.3 * settings.residual * now.load);
}

template class SemismoothNewton<2>;
template class SemismoothNewton<3>;
} // namespace hpvi
