// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_friction_limit_h
#define hpvi_friction_limit_h

#include <functional>
#include <limits>
#include <optional>

namespace hpvi
{
/**
 * The friction that a pressure p allows at one point,
 *
 *     limit(p) = min(most, cohesion + coefficient relative(p) p)  for p > 0, else that of p = 0,
 *
 * concave and never falling: Tresca's law is the cohesion g alone, Coulomb's the coefficient mu_f alone, with
 * relative(p) = mu_f(p)/mu_f(0) where it depends on the pressure; since limit() is concave, mu_f(0) is the largest.
 */
struct FrictionLimit
{
  double cohesion = 0;    ///< without pressure, at least 0 [stress]
  double coefficient = 0; ///< what a unit of pressure adds, at least 0
  double most = std::numeric_limits<double>::infinity(); ///< at any pressure, at least 0 [stress]

  std::function<double(double)> relative = {}; ///< at most 1, of p >= 0; none: 1

  /** `|T_t| = at_zero + slope p` for the pressures of one piece; of a curve its tangent. */
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

  /** Two pressures in a row between which friction falls, or grows by more per pressure than below them. */
  struct Flaw
  {
    double from, to;
    bool falls; ///< else it bends upwards
  };
  /** The first of `coefficient relative(p) p` for p up to @p largest, at 46 pressures: 1/32 of it apart, and halves of that. */
  std::optional<Flaw> flaw(double largest) const;

  double of_pressure(double p) const; ///< coefficient relative(p) p, below 0 coefficient p
};
} // namespace hpvi

#endif
