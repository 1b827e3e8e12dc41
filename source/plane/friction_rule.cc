// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/friction_rule.h>

namespace hpvi
{
using namespace dealii;

FrictionRule make_friction_rule(const std::function<double(double)> &g, const QGauss<1> &gauss,
                                const unsigned int degree, const unsigned int n_parts)
{
  return make_cut_rule(g, gauss, {0, degree - 1, degree}, n_parts);
}
} // namespace hpvi
