// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/moments/contact_moment.h>

#include <algorithm>

namespace hpvi
{
template <int dim>
ContactVector<dim> ContactMoment<dim>::projected(const ContactVector<dim> &z) const
{
  ContactVector<dim> result;
  if (is_friction())
    result = z / std::max(1., z.norm());
  else
    result[0] = kind == Kind::pressure ? std::max(0., z[0]) : z[0];
  return result;
}

template <int dim>
bool ContactMoment<dim>::holds(const ContactVector<dim> &z) const
{
  return is_friction() ? z.norm() <= 1 : kind == Kind::reaction || z[0] > 0;
}

template <int dim>
std::vector<unsigned int> MomentFace<dim>::axes() const
{
  std::vector<unsigned int> result;
  for (unsigned int c = 0; c < dim; ++c)
    if (c == face / 2 ? has_pressure() : has_friction())
      result.push_back(c);
  return result;
}

template struct ContactMoment<2>;
template struct ContactMoment<3>;
template struct MomentFace<2>;
template struct MomentFace<3>;
} // namespace hpvi
