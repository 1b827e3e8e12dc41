// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/loaded_motions.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

template <int dim>
LoadedMotions<dim> loaded_motions(const Discretisation<dim> &discretisation)
{
  const RigidMotions<dim> &free = *discretisation.free_motions;
  const Vector<double> &f = discretisation.system.f;
  const unsigned int n = discretisation.scene.free_motions().size();
  LoadedMotions<dim> result{{}, Vector<double>(n), free.n_seen(), discretisation.scene.thickness};
  for (unsigned int m = 0; m < n; ++m)
  {
    Vector<double> one(n);
    one[m] = 1;
    result.motions.push_back(free.motion(one));
    if (m < free.n_seen())
    {
      result.loads[m] = free.balance().e[m];
      continue;
    }
    const Vector<double> R = free.at_unknowns(one);
    double load = 0, absolute = 0;
    for (unsigned int k = 0; k < R.size(); ++k)
    {
      load += f[k] * R[k];
      absolute += std::abs(f[k] * R[k]);
    }
    if (std::abs(load) > 1e-10 * absolute)
      result.loads[m] = load;
  }
  return result;
}

template LoadedMotions<2> loaded_motions(const Discretisation<2> &);
} // namespace hpvi
