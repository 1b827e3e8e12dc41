// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/closed_forms/hertz.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

EllipticFunction::EllipticFunction(const std::complex<double> &z, const double a)
{
  using Complex = std::complex<double>;
  const Complex zeta = std::sqrt(z - a) * std::sqrt(z + a); // no branch cut: arguments in [0, pi]
  const Complex sum = z + zeta; // z - zeta = a^2/(z + zeta) without cancellation
  F = a * a / 2 * (z / sum + std::log(Complex(0, -1) * sum / a));
  F_1 = a * a / sum;
  y_F_2 = zeta == 0. ? 0. : -z.imag() * F_1 / zeta;
}

double half_ellipse(const double x, const double half_width)
{
  return std::sqrt(std::max((half_width - x) * (half_width + x), 0.));
}

Hertz::Hertz(const Material &material, const double largest_pressure, const double half_width,
             const double centre)
    : SlidingField(material, 0., centre), slope(largest_pressure / half_width),
      half_width(half_width)
{
}

SlidingField::Potentials Hertz::potentials(const Complex &z) const
{
  const EllipticFunction f(z, half_width);
  const Complex factor(0, -slope / 2);
  Potentials p;
  p.phi = factor * f.F;
  p.psi = factor * (f.F - z * f.F_1);
  p.phi_1 = factor * f.F_1;
  p.deviator = -slope * f.y_F_2;
  return p;
}

double Hertz::pressure(const Point<2> &x) const
{
  return slope * half_ellipse(x[0] - origin, half_width);
}

std::vector<Point<2>> Hertz::singularities() const
{
  return transitions();
}

std::vector<Point<2>> Hertz::transitions() const
{
  return {Point<2>(origin - half_width, 0.), Point<2>(origin + half_width, 0.)};
}

ClosedForm hertz_form()
{
  return {
      "hertz",
      "hertz: Contact = unilateral without friction where |d| < L, d = x - Transition, with p = "
      "p_0 sqrt(1 - d^2/L^2), under Gap = d^2 p_0 (1+kappa)/(8 mu L).",
      [](const ClosedFormData &data)
      {
        data.require_contact("unilateral");
        return std::make_shared<Hertz>(data.material, data.number("Pressure"),
                                       data.number("Length"), data.number("Transition"));
      }};
}
} // namespace hpvi
