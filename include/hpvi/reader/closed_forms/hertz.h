// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_hertz_h
#define hpvi_hertz_h

#include <hpvi/reader/closed_forms/closed_form.h>
#include <hpvi/reader/closed_forms/sliding_field.h>

#include <complex>
#include <vector>

namespace hpvi
{
/** F of `F' = z - zeta`, `zeta = sqrt(z^2 - a^2)`, in the upper half plane. */
struct EllipticFunction
{
  EllipticFunction(const std::complex<double> &z, double a);

  std::complex<double> F, F_1; ///< real part of F on y = 0: x^2/2 for |x| < a
  std::complex<double> y_F_2;  ///< y F'', which stays bounded where F'' is not
};

/** `sqrt(a^2 - x^2)` with the @p half_width a, 0 outside. */
double half_ellipse(double x, double half_width);

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

/** For the list of closed_forms(). */
ClosedForm hertz_form();
} // namespace hpvi

#endif
