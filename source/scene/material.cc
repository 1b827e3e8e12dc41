// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/material.h>

#include <algorithm>

namespace hpvi
{
double Material::mu() const
{
  return young / (2 * (1 + poisson));
}

double Material::lambda(const int dim) const
{
  const double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  return dim == 2 && plane == PlaneModel::stress ? 2 * lame * mu() / (lame + 2 * mu()) : lame;
}

double Material::coercivity(const int dim) const
{
  return 2 * mu() + std::min(dim * lambda(dim), 0.);
}

double Material::kolosov() const
{
  return (lambda(2) + 3 * mu()) / (lambda(2) + mu());
}
} // namespace hpvi
