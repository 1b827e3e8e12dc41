// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_partial_slip_h
#define hpvi_partial_slip_h

#include <hpvi/reader/closed_forms/closed_form.h>
#include <hpvi/reader/closed_forms/sliding_field.h>

#include <vector>

namespace hpvi
{
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

/** For the list of closed_forms(). */
ClosedForm partial_slip_form();
} // namespace hpvi

#endif
