// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/friction_limit.h>

#include <algorithm>

namespace hpvi
{
double FrictionLimit::continued(const double p) const
{
  return std::min(most, cohesion + coefficient * p);
}

double FrictionLimit::limit(const double p) const
{
  return continued(std::max(0., p));
}

FrictionLimit::Piece FrictionLimit::piece(const double p) const
{
  if (is_capped(p))
    return {most, 0.};
  return p > 0. ? Piece{cohesion, coefficient} : Piece{cohesion, 0.};
}

double FrictionLimit::slope(const double p) const
{
  return piece(p).slope;
}

bool FrictionLimit::is_capped(const double p) const
{
  return cohesion + coefficient * std::max(0., p) > most;
}

bool FrictionLimit::vanishes() const
{
  return most == 0. || (cohesion == 0. && coefficient == 0.);
}
} // namespace hpvi
