// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_quadratics_h
#define hpvi_quadratics_h

#include <array>

namespace hpvi
{
/** Lagrange's quadratics of the nodes 0, 1/2 and 1 at @p x, or their derivatives of this order. */
inline std::array<double, 3> quadratics(const double x, const unsigned int order)
{
  if (order == 0)
    return {{(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)}};
  if (order == 1)
    return {{4 * x - 3, 4 - 8 * x, 4 * x - 1}};
  return {{4, -8, 4}};
}
} // namespace hpvi

#endif
