// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/closed_forms/stick_slip.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

StickSlip::StickSlip(const Material &material, const double friction_bound, const double transition,
                     const double length)
    : SlidingField(material, friction_bound, transition), length(length),
      amplitude(friction_bound / (1.5 * (1 + kappa) * std::sqrt(length)))
{
}

SlidingField::Potentials StickSlip::potentials(const Complex &z) const
{
  // w = -z = exp(-i pi) z with arg z in [0, pi], hence w^{1/2} = -i z^{1/2} without a branch cut.
  const Complex root = Complex(0, -1) * std::sqrt(z), w = -z;
  Potentials p;
  p.phi = amplitude * w * root;
  p.psi = -(kappa + 1.5) * p.phi;
  p.phi_1 = -1.5 * amplitude * root;
  const Complex z_conjugate_phi_2 = z == 0. ? 0. : 0.75 * amplitude * std::conj(z) / root;
  p.deviator = z_conjugate_phi_2 - (kappa + 1.5) * p.phi_1;
  return p;
}

double StickSlip::multiplier(const Point<2> &x) const
{
  return 1 - std::sqrt(std::max(x[0] - origin, 0.) / length);
}

std::vector<Point<2>> StickSlip::singularities() const
{
  return transitions();
}

std::vector<Point<2>> StickSlip::transitions() const
{
  return {Point<2>(origin, 0.)};
}

ClosedForm stick_slip_form()
{
  return {
      "stick-slip",
      "stick-slip: sticks where x > Transition, lambda = 1 - sqrt((x - Transition)/Length), and "
      "slips elsewhere, with a constant friction bound.",
      [](const ClosedFormData &data)
      {
        return std::make_shared<StickSlip>(
            data.material, data.require_friction_bound([](const double g) { return g > 0; }),
            data.number("Transition"), data.number("Length"));
      }};
}
} // namespace hpvi
