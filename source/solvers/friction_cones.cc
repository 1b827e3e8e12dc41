// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numbers.h>
#include <hpvi/solvers/friction_cones.h>

namespace hpvi
{
using namespace dealii;

FeasibleSet FrictionCones::at(const Vector<double> &z) const
{
  Vector<double> lower(fixed.size()), upper(fixed.size());
  for (unsigned int i = 0; i < fixed.size(); ++i)
  {
    lower[i] = -infinity;
    upper[i] = infinity;
  }
  fixed.project(lower); // the nearest points to infinity are the sides
  fixed.project(upper);
  for (const Cone &cone : cones)
  {
    upper[cone.tangential] = cone.friction.limit(z[cone.normal]);
    lower[cone.tangential] = -upper[cone.tangential];
  }
  return FeasibleSet(lower, upper);
}
} // namespace hpvi
