// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/driver/thickness.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
template <class... Numbers>
void multiply(const double factor, Numbers &...numbers)
{
  ((numbers *= factor), ...);
}

void take(const double b, const double root, ErrorBound &bound)
{
  multiply(root, bound.total, bound.estimate, bound.radius, bound.stress, bound.slip,
           bound.oscillation, bound.data, bound.hysteresis);
  multiply(b, bound.energy, bound.energy_below, bound.energy_above);
  for (double &square : bound.squares)
    square *= b;
}

template <int dim>
void take(const double b, Resultant<dim> &row)
{
  for (Measured &component : row.force)
    component.multiply(b);
  for (Measured &component : row.moment)
    component.multiply(b);
  row.normal.multiply(b);
  row.friction.multiply(b);
}

template <int dim>
void take(const double b, ContactState<dim> &state)
{
  multiply(b, state.normal_resultant, state.friction_resultant, state.friction_force,
           state.absolute_friction, state.open_friction, state.tension);
}
} // namespace

template <int dim>
void take_thickness(StepReport<dim> &step)
{
  const double b = step.scene.thickness, root = std::sqrt(b);
  if (b == 1)
    return;
  EstimateNorms &norms = step.norms;
  multiply(root, norms.volume, norms.jumps, norms.neumann, norms.contact, norms.normal,
           norms.penetration, norms.tension, norms.excess, norms.total, step.scaled_estimate);
  if (step.bound)
    take(b, root, *step.bound);
  step.equilibrated.norm *= root;
  multiply(b, step.energies.lagrangian, step.energies.energy, step.energies.slack,
           step.energy_high);
  step.energies.norm *= root;
  TrueErrors &errors = step.errors; // J(u) stands in its file as that run has reported it
  multiply(root, errors.energy, errors.energy_norm, errors.l2, errors.multiplier_l2,
           errors.pressure_l2);
  for (ContactState<dim> &state : step.contact)
    take(b, state);
  for (BoundaryForce<dim> &force : step.equilibrium.reactions)
    multiply(b, force.force, force.moment);
  for (PlateState<dim> &plate : step.equilibrium.plates)
    plate.moment *= b;
  for (BoundaryForce<dim> &load : step.equilibrium.parts_of_loads)
    multiply(b, load.force, load.moment);
  multiply(b, step.equilibrium.loads.force, step.equilibrium.loads.moment);
  for (Resultant<dim> &row : step.forces)
    take(b, row);
}

template void take_thickness(StepReport<2> &);
template void take_thickness(StepReport<3> &);
} // namespace hpvi
