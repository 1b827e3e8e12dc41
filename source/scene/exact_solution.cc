// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/exact_solution.h>

#include <algorithm>
#include <cmath>
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
  const Complex by_conjugate = -std::conj(p.z_conjugate_phi_2 + p.psi_1) / (2 * mu);
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
  p.psi_1 = -(kappa + 1.5) * p.phi_1;
  p.z_conjugate_phi_2 = z == 0. ? 0. : 0.75 * amplitude * std::conj(z) / root;
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
  p.psi_1 = -p.phi_1;
  p.z_conjugate_phi_2 = std::conj(z) * p.phi_1 / length;
  return p;
}

double Smooth::multiplier(const Point<2> &) const
{
  return friction_bound > 0 ? 1. : 0.;
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
