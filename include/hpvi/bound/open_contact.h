// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_open_contact_h
#define hpvi_open_contact_h

#include <hpvi/bound/error_bound.h>

#include <vector>

namespace hpvi
{
/**
 * Where unilateral contact is open along a boundary, from one of its ends on: there the exact pressure p does little work,
 *
 *     int p (u_0 - U_n) <= J(U) - J(u) <= ErrorBound::energy,
 *
 * so that for a fall f(s) <= kappa (u_0 - U_n) the work int p f is at most kappa times that bound.
 */
class OpenContact
{
public:
  /** From the end @p from of @p boundary. */
  OpenContact(const Solution<2> &solution, const ErrorBound &bound, unsigned int boundary,
              const dealii::Point<2> &from);

  double length() const; ///< how far; 0: it presses there, or two bodies touch

  /** kappa for `f = 1 - s/l`, l <= length(). */
  double kappa(double l) const;

private:
  struct Piece
  {
    double begin, end; ///< distances from the end of the boundary
    double room;       ///< u_0 - U_n is no less
  };
  std::vector<Piece> pieces; ///< one after the other
};
} // namespace hpvi

#endif
