// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/space/augmented_lagrangian.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int maximum_steps = 60; ///< of one minimisation
} // namespace

template <int dim>
AugmentedLagrangian<dim>::AugmentedLagrangian(const PrimalSpace<dim> &space,
                                              const PrimalSystem<dim> &system,
                                              NewtonMatrix<dim> &matrix,
                                              const std::vector<double> &weights,
                                              const std::vector<ContactVector<dim>> &start)
    : space(space), system(system), matrix(matrix), weights(weights), lambda(start)
{
  growth = space.scene.materials[0].modulus(dim) / space.scene.geometry.diameter();
  for (unsigned int k = 0; k < lambda.size(); ++k)
    lambda[k] = space.contact[k].projected(lambda[k]);
}

/** `G_k c_k`: at first that of a body as thick as this one, in the end several times what a contact dof meets in A. */
template <int dim>
double AugmentedLagrangian<dim>::stiffness(const unsigned int k) const
{
  return std::min(growth * space.contact[k].area, 20 * trace(matrix.block(k)) / (dim - 1));
}

template <int dim>
ContactVector<dim> AugmentedLagrangian<dim>::argument(const DistributedVector &v,
                                                      const unsigned int k) const
{
  const ContactDof<dim> &contact_dof = space.contact[k];
  return lambda[k] + stiffness(k) / weights[k] * (space.contact_value(v, k) - contact_dof.gap);
}

template <int dim>
DistributedVector AugmentedLagrangian<dim>::gradient(const DistributedVector &v) const
{
  DistributedVector result = v;
  matrix.multiply(result, v);
  result -= system.f;
  for (unsigned int k = 0; k < lambda.size(); ++k)
    if (const double G = weights[k]; G > 0)
      space.add_contact_value(result, k, G * space.contact[k].projected(argument(v, k)));
  return result;
}

/** How far the update of lambda would move forces. */
template <int dim>
double AugmentedLagrangian<dim>::change(const DistributedVector &v) const
{
  double sum = 0;
  for (unsigned int k = 0; k < lambda.size(); ++k)
    if (const double G = weights[k]; G > 0)
      sum += (G * (space.contact[k].projected(argument(v, k)) - lambda[k])).norm_square();
  return std::sqrt(Utilities::MPI::sum(sum, space.communicator()));
}

/** Of the contact: the root of the sum of their squares. Without loads they say what round-off is. */
template <int dim>
double AugmentedLagrangian<dim>::contact_forces() const
{
  double sum = 0;
  for (unsigned int k = 0; k < lambda.size(); ++k)
    sum += (weights[k] * lambda[k]).norm_square();
  return std::sqrt(Utilities::MPI::sum(sum, space.communicator()));
}

template <int dim>
std::vector<ContactDofState<dim>> AugmentedLagrangian<dim>::states(const DistributedVector &v) const
{
  std::vector<ContactDofState<dim>> result(lambda.size());
  for (unsigned int k = 0; k < lambda.size(); ++k)
  {
    if (!(weights[k] > 0))
      continue;
    const ContactVector<dim> z = argument(v, k);
    if (!space.contact[k].is_friction())
    {
      if (space.contact[k].holds(z))
        result[k].stiffness = stiffness(k) * unit_symmetric_tensor<dim - 1>();
      continue;
    }
    const double size = z.norm();
    for (unsigned int s = 0; s < dim - 1; ++s)
      for (unsigned int t = 0; t <= s; ++t)
        result[k].stiffness[s][t] =
            stiffness(k) * (size <= 1  ? (s == t ? 1. : 0.)
                            : dim == 2 ? 0. // no direction is left
                                       : ((s == t ? 1. : 0.) - z[s] * z[t] / (size * size)) / size);
  }
  return result;
}

/** The derivative of the terms of contact at `v + length step` along @p step. */
template <int dim>
double AugmentedLagrangian<dim>::work_of_contact(const DistributedVector &v,
                                                 const DistributedVector &step,
                                                 const double length) const
{
  double sum = 0;
  for (unsigned int k = 0; k < lambda.size(); ++k)
    if (const double G = weights[k]; G > 0)
    {
      const ContactVector<dim> m = space.contact_value(step, k);
      sum += G * space.contact[k].projected(argument(v, k) + length * stiffness(k) / G * m) * m;
    }
  return Utilities::MPI::sum(sum, space.communicator());
}

/** One, or where the function rises again before that its minimum along @p step. */
template <int dim>
double AugmentedLagrangian<dim>::length_of(const DistributedVector &v,
                                           const DistributedVector &step,
                                           const DistributedVector &gradient) const
{
  DistributedVector product = v;
  matrix.multiply(product, step);
  const double curvature = step * product, slope = gradient * step,
               linear = slope - work_of_contact(v, step, 0);
  const auto derivative = [&](const double length)
  { return linear + length * curvature + work_of_contact(v, step, length); };
  if (!(derivative(1) > 0.5 * std::abs(slope)))
    return 1;
  double begin = 0, end = 1;
  for (unsigned int i = 0; i < 30; ++i)
    (derivative(0.5 * (begin + end)) < 0 ? begin : end) = 0.5 * (begin + end);
  return 0.5 * (begin + end);
}

template <int dim>
unsigned int AugmentedLagrangian<dim>::update(DistributedVector &v)
{
  unsigned int n_steps = 0;
  DistributedVector b = gradient(v);
  for (double size = b.l2_norm(), previous = size; size > 0.1 * change(v);
       previous = size, size = b.l2_norm(), ++n_steps)
  {
    if (size <= 1e-14 * std::max(system.f.l2_norm(), contact_forces()))
      break;
    if (n_steps == maximum_steps)
      throw NumericalFailure("the augmented Lagrangian does not converge");
    matrix.linearise(states(v), n_steps == 0);
    b *= -1;
    DistributedVector step = space.owned_vector();
    matrix.solve(step, b, std::clamp(size / previous, 1e-3, 0.1) * size);
    b *= -1;
    v.add(length_of(v, step, b), step);
    b = gradient(v);
  }
  for (unsigned int k = 0; k < lambda.size(); ++k)
    if (weights[k] > 0)
      lambda[k] = space.contact[k].projected(argument(v, k));
  growth *= 10;
  return n_steps;
}

template class AugmentedLagrangian<2>;
template class AugmentedLagrangian<3>;
} // namespace hpvi
