// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_smooth_h
#define hpvi_smooth_h

#include <hpvi/reader/closed_forms/closed_form.h>
#include <hpvi/reader/closed_forms/sliding_field.h>

namespace hpvi
{
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

/** For the list of closed_forms(). */
ClosedForm smooth_form();
} // namespace hpvi

#endif
