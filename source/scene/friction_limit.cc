// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/friction_limit.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
namespace
{
/** Of differences in relative pressure: errors of 1e-9 of the slope, and as much round-off. */
constexpr double step = 1e-4;

/** Of chords between sampled pressures, in parts of the largest slope. */
constexpr double round_off = 1e-9;
} // namespace

double FrictionLimit::of_pressure(const double p) const
{
  return relative && p > 0. ? coefficient * relative(p) * p : coefficient * p;
}

double FrictionLimit::continued(const double p) const
{
  return std::min(most, cohesion + of_pressure(p));
}

double FrictionLimit::limit(const double p) const
{
  return continued(std::max(0., p));
}

FrictionLimit::Piece FrictionLimit::piece(const double p) const
{
  if (is_capped(p))
    return {most, 0.};
  if (!(p > 0.))
    return {cohesion, 0.};
  if (!relative)
    return {cohesion, coefficient};
  // (mu p)' = mu + p mu', where the product with p takes what is small out of the difference.
  const double slope =
      coefficient *
      (relative(p) + (relative((1. + step) * p) - relative((1. - step) * p)) / (2. * step));
  return {cohesion + of_pressure(p) - slope * p, slope};
}

double FrictionLimit::slope(const double p) const
{
  return piece(p).slope;
}

bool FrictionLimit::is_capped(const double p) const
{
  return cohesion + of_pressure(std::max(0., p)) > most;
}

bool FrictionLimit::vanishes() const
{
  return most == 0. || (cohesion == 0. && coefficient == 0.);
}

std::optional<FrictionLimit::Flaw> FrictionLimit::flaw(const double largest) const
{
  if (!relative || coefficient == 0.)
    return std::nullopt;
  constexpr int parts = 32, halvings = 14;
  double last = 0, friction = 0, slope = coefficient;
  for (int k = -halvings; k < parts; ++k)
  {
    const double p = largest * (k < 0 ? std::ldexp(1. / parts, k) : double(k + 1) / parts),
                 next = of_pressure(p), chord = (next - friction) / (p - last);
    if (!(chord >= -round_off * coefficient) || chord > slope + round_off * coefficient)
      return Flaw{last, p, chord < 0.};
    last = p;
    friction = next;
    slope = chord;
  }
  return std::nullopt;
}
} // namespace hpvi
