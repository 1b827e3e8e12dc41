// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_sliding_field_h
#define hpvi_sliding_field_h

#include <hpvi/scene/exact_solution.h>

#include <complex>

namespace hpvi
{
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
} // namespace hpvi

#endif
