// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/initial_strain.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

template <int dim>
InitialStrain<dim>::operator bool() const
{
  return shortening || (expansion != 0. && temperature) ||
         std::any_of(components.begin(), components.end(),
                     [](const Expression<dim> &component) { return component != nullptr; });
}

template <int dim>
PlaneStrain InitialStrain<dim>::value(const Point<dim> &x) const
{
  PlaneStrain strain{};
  for (unsigned int k = 0; k < 4; ++k)
    if (components[k])
      strain[k] = components[k]->value(x);
  if (expansion != 0. && temperature)
  {
    const double expanded = expansion * temperature->value(x);
    for (const unsigned int k : {0, 1, 3})
      strain[k] += expanded;
  }
  for (unsigned int k = 0; shortening && k < 4; ++k)
    strain[k] += (*shortening)[k];
  return strain;
}

template struct InitialStrain<2>;
template struct InitialStrain<3>;
} // namespace hpvi
