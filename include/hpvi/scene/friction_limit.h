// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_friction_limit_h
#define hpvi_friction_limit_h

#include <limits>

namespace hpvi
{
/**
 * The friction that a pressure p allows at one point,
 *
 *     limit(p) = min(most, cohesion + coefficient max(0, p)),
 *
 * concave and never falling: Tresca's law is the cohesion g alone, Coulomb's the coefficient mu_f alone.
 */
struct FrictionLimit
{
  double cohesion = 0;    ///< without pressure, at least 0 [stress]
  double coefficient = 0; ///< what a unit of pressure adds, at least 0
  double most = std::numeric_limits<double>::infinity(); ///< at any pressure, at least 0 [stress]

  /** `|T_t| = at_zero + slope p` for the pressures of one piece. */
  struct Piece
  {
    double at_zero, slope;
  };

  double limit(double p) const;
  double slope(double p) const;     ///< the derivative; at a kink that of smaller p
  double continued(double p) const; ///< limit(p), below 0 the piece that begins there
  Piece piece(double p) const;      ///< the one that p is on
  bool is_capped(double p) const;   ///< is it that of `most`?
  bool vanishes() const;            ///< for every pressure
};
} // namespace hpvi

#endif
