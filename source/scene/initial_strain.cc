// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/initial_strain.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

template <>
const std::array<const char *, 4> &strain_names<2>()
{
  static const std::array<const char *, 4> names{{"e1", "e2", "e12", "e33"}};
  return names;
}

template <>
const std::array<const char *, 6> &strain_names<3>()
{
  static const std::array<const char *, 6> names{{"e1", "e2", "e3", "e12", "e13", "e23"}};
  return names;
}

template <int dim>
InitialStrain<dim>::operator bool() const
{
  return shortening || (expansion != 0. && temperature) ||
         std::any_of(components.begin(), components.end(),
                     [](const Expression<dim> &component) { return component != nullptr; });
}

template <int dim>
StrainComponents<dim> InitialStrain<dim>::value(const Point<dim> &x) const
{
  StrainComponents<dim> strain{};
  for (unsigned int k = 0; k < strain.size(); ++k)
    if (components[k])
      strain[k] = components[k]->value(x);
  if (expansion != 0. && temperature)
  {
    const double expanded = expansion * temperature->value(x);
    for (const unsigned int k : {0, 1, dim == 2 ? 3 : 2})
      strain[k] += expanded;
  }
  for (unsigned int k = 0; shortening && k < strain.size(); ++k)
    strain[k] += (*shortening)[k];
  return strain;
}

template struct InitialStrain<2>;
template struct InitialStrain<3>;
} // namespace hpvi
