// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stick_slip_h
#define hpvi_stick_slip_h

#include <hpvi/reader/closed_forms/closed_form.h>
#include <hpvi/reader/closed_forms/sliding_field.h>

#include <vector>

namespace hpvi
{
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

/** For the list of closed_forms(). */
ClosedForm stick_slip_form();
} // namespace hpvi

#endif
