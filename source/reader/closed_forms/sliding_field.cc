// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/closed_forms/sliding_field.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

SlidingField::SlidingField(const Material &material, const double friction_bound,
                           const double origin)
    : mu(material.mu()), kappa(material.kolosov()), friction_bound(friction_bound), origin(origin)
{
}

/** Round-off below the contact edge must not land on the other side of a branch cut. */
SlidingField::Complex SlidingField::position(const Point<2> &x) const
{
  return {x[0] - origin, std::abs(x[1])};
}

Tensor<1, 2> SlidingField::displacement(const Point<2> &x) const
{
  const Complex z = position(x);
  const Potentials p = potentials(z);
  const Complex u = (kappa * p.phi - z * std::conj(p.phi_1) - std::conj(p.psi)) / (2 * mu);
  return Tensor<1, 2>({u.real() + friction_bound / mu * z.imag(), u.imag()});
}

Tensor<2, 2> SlidingField::gradient(const Point<2> &x) const
{
  const Potentials p = potentials(position(x));
  // Of u = u_x + i u_y, the derivatives d/dx = d/dz + d/d conj(z), d/dy = i (d/dz - d/d conj(z)).
  const Complex by_z = (kappa * p.phi_1 - std::conj(p.phi_1)) / (2 * mu);
  const Complex by_conjugate = -std::conj(p.deviator) / (2 * mu);
  const Complex by_x = by_z + by_conjugate, by_y = Complex(0, 1) * (by_z - by_conjugate);
  Tensor<2, 2> result;
  result[0][0] = by_x.real();
  result[0][1] = by_y.real() + friction_bound / mu;
  result[1][0] = by_x.imag();
  result[1][1] = by_y.imag();
  return result;
}
} // namespace hpvi
