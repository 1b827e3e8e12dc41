// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/closed_forms/smooth.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

Smooth::Smooth(const Material &material, const double friction_bound, const double origin,
               const double length)
    : SlidingField(material, friction_bound, origin), length(length)
{
}

SlidingField::Potentials Smooth::potentials(const Complex &z) const
{
  Potentials p;
  p.phi_1 = mu / 4 * std::exp(z / length);
  p.phi = length * p.phi_1;
  p.psi = -p.phi;
  p.deviator = std::conj(z) * p.phi_1 / length - p.phi_1;
  return p;
}

double Smooth::multiplier(const Point<2> &) const
{
  return friction_bound > 0 ? 1. : 0.;
}

ClosedForm smooth_form()
{
  return {"smooth",
          "smooth: slips everywhere, u_x = (L/8) exp(s) (1 + kappa - s) on y = 0, s = (x - "
          "Transition)/L, with a constant friction bound.",
          [](const ClosedFormData &data)
          {
            return std::make_shared<Smooth>(
                data.material, data.require_friction_bound([](const double g) { return g >= 0; }),
                data.number("Transition"), data.number("Length"));
          }};
}
} // namespace hpvi
