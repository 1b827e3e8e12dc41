// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/closed_forms/hertz.h>
#include <hpvi/reader/closed_forms/partial_slip.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

PartialSlip::PartialSlip(const Material &material, const double largest_bound,
                         const double half_width, const double stick_length, const double centre)
    : SlidingField(material, 0., centre), slope(largest_bound / half_width), half_width(half_width),
      stick_length(stick_length)
{
}

SlidingField::Potentials PartialSlip::potentials(const Complex &z) const
{
  const EllipticFunction outer(z, half_width), inner(z, stick_length);
  const Complex F = outer.F - inner.F, F_1 = outer.F_1 - inner.F_1,
                y_F_2 = outer.y_F_2 - inner.y_F_2;
  const double factor = slope / 2;
  Potentials p;
  p.phi = factor * F;
  p.psi = -factor * (F + z * F_1);
  p.phi_1 = factor * F_1;
  p.deviator = -2 * factor * (F_1 + Complex(0, 1) * y_F_2);
  return p;
}

double PartialSlip::multiplier(const Point<2> &x) const
{
  const double distance = std::abs(x[0] - origin);
  return distance < stick_length
             ? 1 - half_ellipse(distance, stick_length) / half_ellipse(distance, half_width)
             : 1.;
}

std::vector<Point<2>> PartialSlip::singularities() const
{
  std::vector<Point<2>> points = transitions();
  for (const double end : {-half_width, half_width})
    points.emplace_back(origin + end, 0.);
  return points;
}

std::vector<Point<2>> PartialSlip::transitions() const
{
  return {Point<2>(origin - stick_length, 0.), Point<2>(origin + stick_length, 0.)};
}

ClosedForm partial_slip_form()
{
  return {"partial-slip",
          "partial-slip: Contact = tangential with Friction bound = p_0 sqrt(max(0, 1 - d^2/L^2)) "
          "sticks where |d| < Stick length and slips around.",
          [](const ClosedFormData &data)
          {
            data.require_contact("tangential");
            const double half_width = data.number("Length"),
                         stick_length = data.number("Stick length");
            if (!(stick_length < half_width))
              data.parameters.reject("Exact solution", "Stick length",
                                     "leaves no slip within Length = " +
                                         data.parameters.text("Exact solution", "Length") +
                                         "; give less");
            return std::make_shared<PartialSlip>(data.material, data.number("Pressure"), half_width,
                                                 stick_length, data.number("Transition"));
          }};
}
} // namespace hpvi
