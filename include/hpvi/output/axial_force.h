// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_axial_force_h
#define hpvi_axial_force_h

#include <hpvi/base/formatting.h>
#include <hpvi/results/contact_state.h>
#include <hpvi/results/equilibrium.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
/** Has it a part along the axis alone, as forces on an axisymmetric body? */
template <int dim>
bool is_axial(const dealii::Tensor<1, dim> &force)
{
  return std::isnan(force[0]);
}

/** |F|, of an axial force that of its part along the axis. */
template <int dim>
double magnitude(const dealii::Tensor<1, dim> &force)
{
  return is_axial<dim>(force) ? std::abs(force[1]) : force.norm();
}

/** Forces below a part of this are round-off. */
template <int dim>
double largest_force(const Equilibrium<dim> &equilibrium)
{
  double largest = magnitude<dim>(equilibrium.loads.force);
  for (const BoundaryForce<dim> &force : equilibrium.reactions)
    largest = std::max(largest, magnitude<dim>(force.force));
  return largest;
}

/** As in "axial force 3"; round-off beside @p scale is zero. */
template <int dim>
std::string axial_force_in_words(const dealii::Tensor<1, dim> &force, const double scale)
{
  return "axial force " + text(std::abs(force[1]) > 1e-12 * scale ? force[1] : 0., 6);
}
/** Beside which a force is round-off: around a closed curve tractions balance each other. */
template <int dim>
double force_scale(const Equilibrium<dim> &equilibrium, const ContactState<dim> &state)
{
  return std::max(largest_force(equilibrium),
                  std::abs(state.normal_resultant) + state.absolute_friction);
}
} // namespace hpvi

#endif
