// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_exact_solution_h
#define hpvi_exact_solution_h

#include <hpvi/scene/material.h>

#include <deal.II/base/function.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <complex>
#include <memory>
#include <vector>

namespace hpvi
{
/** A displacement field that solves the scene's problem in closed form. */
template <int dim>
class ExactSolution
{
public:
  virtual ~ExactSolution() = default;

  virtual dealii::Tensor<1, dim> displacement(const dealii::Point<dim> &x) const = 0;

  /** The entry (i,j) is `d u_i / d x_j`. */
  virtual dealii::Tensor<2, dim> gradient(const dealii::Point<dim> &x) const = 0;

  /** `lambda = -sigma_t/g` on the contact boundary; 0 without friction. */
  virtual double multiplier(const dealii::Point<dim> &x) const;

  /** `-T_n >= 0` [stress] on a contact boundary that may open; 0 where none does. */
  virtual double pressure(const dealii::Point<dim> &x) const;

  /** Points where the stress is not smooth: quadrature is graded towards them. */
  virtual std::vector<dealii::Point<dim>> singularities() const;

  /** Points of the contact boundary where its state changes: stick meets slip, contact ends. */
  virtual std::vector<dealii::Point<dim>> transitions() const;
};

/**
 * Plane fields without body force that slide along y = 0 (the body is above it), from potentials
 * phi and psi (Muskhelishvili 1953, Section 32): with z = x - c + iy
 *
 *     2 mu (u_x + i u_y) = kappa phi - z conj(phi') - conj(psi),     then u_x += (g/mu) y,
 *
 * where the last term adds a constant shear stress g, that of a contact edge which slips. Potentials
 * that are real on the slip zone leave `u_y = 0` there.
 */
class SlidingField : public ExactSolution<2>
{
public:
  dealii::Tensor<1, 2> displacement(const dealii::Point<2> &x) const override final;
  dealii::Tensor<2, 2> gradient(const dealii::Point<2> &x) const override final;

protected:
  using Complex = std::complex<double>;

  struct Potentials
  {
    Complex phi, psi; ///< [stress * length]
    Complex phi_1;    ///< phi'
    Complex deviator; ///< `conj(z) phi'' + psi'`, a sum that stays bounded where its terms do not
  };

  SlidingField(const Material &material, double friction_bound, double origin);

  virtual Potentials potentials(const Complex &z) const = 0;

  const double mu, kappa;
  const double friction_bound; ///< g >= 0 on y = 0
  const double origin;         ///< c, where z = 0

private:
  Complex position(const dealii::Point<2> &x) const;
};

/**
 * Stick meets slip: on y = 0 the body slips for x < c and sticks for x > c. With `w = -z`,
 *
 *     phi = A w^{3/2},  psi = -(kappa + 3/2) A w^{3/2},  A = g/((3/2)(1+kappa) sqrt(L)),
 *
 *     slip  x < c:  u_x = (kappa A/mu) (c-x)^{3/2} > 0,  lambda = 1
 *     stick x > c:  u = 0,  lambda = 1 - sqrt((x-c)/L), admissible up to x - c = 4 L.
 *
 * The stress has the term r^{1/2}: the strongest singularity at which the friction law holds.
 */
class StickSlip : public SlidingField
{
public:
  /** @p length is L, the distance from the transition c at which the friction stress vanishes. */
  StickSlip(const Material &material, double friction_bound, double transition, double length);

  double multiplier(const dealii::Point<2> &x) const override;
  std::vector<dealii::Point<2>> singularities() const override;
  std::vector<dealii::Point<2>> transitions() const override;

protected:
  Potentials potentials(const Complex &z) const override;

private:
  const double length;
  const double amplitude; ///< A
};

/**
 * An entire field that slips everywhere: `phi = (mu L/4) exp(z/L)`, `psi = -phi`, hence
 *
 *     u_x(x, 0) = (L/8) exp((x-c)/L) (1 + kappa - (x-c)/L) > 0 and lambda = 1 for x - c < (1 +
 * kappa) L.
 */
class Smooth : public SlidingField
{
public:
  Smooth(const Material &material, double friction_bound, double origin, double length);

  double multiplier(const dealii::Point<2> &x) const override;

protected:
  Potentials potentials(const Complex &z) const override;

private:
  const double length;
};

/**
 * Hertz's contact with a plane, without friction: with half-width a, `p_0 = k a` and the function F
 * of `F' = z - sqrt(z^2 - a^2)`,
 *
 *     phi = -(ik/2) F,  psi = -(ik/2) (F - z F'),
 *
 *     contact |x-c| < a:  p = k sqrt(a^2 - (x-c)^2),  u_n = u_0
 *     open    |x-c| > a:  p = 0,  u_n < u_0 = (1+kappa) k (x-c)^2/(8 mu).
 *
 * That gap is the parabola (x-c)^2/(2R) with `p_0 = a E/(2 (1-nu^2) R)` in plane strain.
 */
class Hertz : public SlidingField
{
public:
  /** @p largest_pressure is p_0, @p half_width a and @p centre c. */
  Hertz(const Material &material, double largest_pressure, double half_width, double centre);

  double pressure(const dealii::Point<2> &x) const override;
  std::vector<dealii::Point<2>> singularities() const override;
  std::vector<dealii::Point<2>> transitions() const override;

protected:
  Potentials potentials(const Complex &z) const override;

private:
  const double slope; ///< k [stress/length]
  const double half_width;
};

/**
 * Partial slip under the bound `g = k sqrt(a^2 - x^2)` for |x| < a, 0 elsewhere, where no normal
 * traction acts (Cattaneo and Mindlin; their middle half-width c is here the stick length b, x counts
 * from the origin c): the difference of the fields with half-widths a and b of
 *
 *     phi = (k/2) F,  psi = -(k/2) (F + z F'),    F as for Hertz's contact,
 *
 *     stick |x| < b:      u_x = 0,  lambda = 1 - sqrt((b^2 - x^2)/(a^2 - x^2))
 *     slip  b < |x| < a:  u_x > 0,  lambda = 1.
 */
class PartialSlip : public SlidingField
{
public:
  /** @p largest_bound is `k a`, the bound in the @p centre; stick_length < half_width. */
  PartialSlip(const Material &material, double largest_bound, double half_width,
              double stick_length, double centre);

  double multiplier(const dealii::Point<2> &x) const override;
  std::vector<dealii::Point<2>> singularities() const override;
  std::vector<dealii::Point<2>> transitions() const override; ///< not at +-a, where g ends

protected:
  Potentials potentials(const Complex &z) const override;

private:
  const double slope; ///< k [stress/length]
  const double half_width, stick_length;
};

/** One component of the displacement of an exact solution, for prescribed boundary values. */
template <int dim>
class ExactDisplacement : public dealii::Function<dim>
{
public:
  ExactDisplacement(std::shared_ptr<const ExactSolution<dim>> solution, unsigned int component);

  double value(const dealii::Point<dim> &x, unsigned int component = 0) const override;

private:
  const std::shared_ptr<const ExactSolution<dim>> solution;
  const unsigned int direction;
};

/** One component of the traction `sigma n` of an exact solution on a straight boundary. */
template <int dim>
class ExactTraction : public dealii::Function<dim>
{
public:
  ExactTraction(std::shared_ptr<const ExactSolution<dim>> solution, const Material &material,
                const dealii::Tensor<1, dim> &normal, unsigned int component);

  double value(const dealii::Point<dim> &x, unsigned int component = 0) const override;

private:
  const std::shared_ptr<const ExactSolution<dim>> solution;
  const Material material;
  const dealii::Tensor<1, dim> normal;
  const unsigned int direction;
};
} // namespace hpvi

#endif
