// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/material.h>

#include <algorithm>

namespace hpvi
{
/**
 * The smallest eigenvalue of Hooke's law on symmetric tensors: 2 mu without, `2 mu + dim lambda`
 * with change of volume, which is the smaller one where nu < 0.
 */
double Material::coercivity(const int dim) const
{
  return 2 * mu() + std::min(dim * lambda(dim), 0.);
}

double Material::kolosov() const
{
  return (lambda(2) + 3 * mu()) / (lambda(2) + mu());
}
} // namespace hpvi
