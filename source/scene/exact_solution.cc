// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/exact_solution.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace hpvi
{
using namespace dealii;

template <int dim>
double ExactSolution<dim>::multiplier(const Point<dim> &) const
{
  return 0.;
}

template <int dim>
double ExactSolution<dim>::pressure(const Point<dim> &) const
{
  return 0.;
}

template <int dim>
std::vector<Point<dim>> ExactSolution<dim>::singularities() const
{
  return {};
}

template <int dim>
std::vector<Point<dim>> ExactSolution<dim>::transitions() const
{
  return {};
}

// ---------------------------------------------------------------- fields from two potentials

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

// ---------------------------------------------------------------- stick meets slip

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

// ---------------------------------------------------------------- an entire function

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

// ---------------------------------------------------------------- half planes under sqrt(a^2 - x^2)

namespace
{
/** F of `F' = z - zeta`, `zeta = sqrt(z^2 - a^2)`, in the upper half plane. */
struct EllipticFunction
{
  EllipticFunction(const std::complex<double> &z, const double a)
  {
    using Complex = std::complex<double>;
    const Complex zeta = std::sqrt(z - a) * std::sqrt(z + a); // no branch cut: arguments in [0, pi]
    const Complex sum = z + zeta; // z - zeta = a^2/(z + zeta) without cancellation
    F = a * a / 2 * (z / sum + std::log(Complex(0, -1) * sum / a));
    F_1 = a * a / sum;
    y_F_2 = zeta == 0. ? 0. : -z.imag() * F_1 / zeta;
  }

  std::complex<double> F, F_1; ///< real part of F on y = 0: x^2/2 for |x| < a
  std::complex<double> y_F_2;  ///< y F'', which stays bounded where F'' is not
};

double half_ellipse(const double x, const double half_width)
{
  return std::sqrt(std::max((half_width - x) * (half_width + x), 0.));
}
} // namespace

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

// ---------------------------------------------------------------- boundary values

template <int dim>
ExactDisplacement<dim>::ExactDisplacement(std::shared_ptr<const ExactSolution<dim>> solution,
                                          const unsigned int component)
    : solution(std::move(solution)), direction(component)
{
}

template <int dim>
double ExactDisplacement<dim>::value(const Point<dim> &x, unsigned int) const
{
  return solution->displacement(x)[direction];
}

template <int dim>
ExactTraction<dim>::ExactTraction(std::shared_ptr<const ExactSolution<dim>> solution,
                                  const Material &material, const Tensor<1, dim> &normal,
                                  const unsigned int component)
    : solution(std::move(solution)), material(material), normal(normal), direction(component)
{
}

template <int dim>
double ExactTraction<dim>::value(const Point<dim> &x, unsigned int) const
{
  return HookesLaw<dim>(material).traction(solution->gradient(x), normal)[direction];
}

template class ExactSolution<2>;
template class ExactDisplacement<2>;
template class ExactTraction<2>;
} // namespace hpvi
