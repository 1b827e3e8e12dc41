// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/contact_dof.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

template <int dim>
ContactVector<dim> ContactDof<dim>::projected(const ContactVector<dim> &z) const
{
  ContactVector<dim> result;
  if (kind == Kind::glue)
    result = z;
  else if (is_friction())
    result = z / std::max(1., z.norm());
  else
    result[0] = kind == Kind::pressure ? std::max(0., z[0]) : z[0];
  return result;
}

template <int dim>
bool ContactDof<dim>::holds(const ContactVector<dim> &z) const
{
  switch (kind)
  {
  case Kind::friction:
    return z.norm() <= 1;
  case Kind::pressure:
    return z[0] > 0;
  default:
    return true;
  }
}

template <int dim>
std::vector<unsigned int> ContactDofFace<dim>::components() const
{
  std::vector<unsigned int> result;
  for (unsigned int c = 0; c < dim; ++c)
    if (axes.is_rotated() || (c == normal() ? has_pressure() : has_friction()))
      result.push_back(c);
  return result;
}

template <int dim>
unsigned int ContactDofFace<dim>::tangential(const unsigned int s) const
{
  return axes.is_rotated() || s < axes.axis ? s : s + 1;
}

template <int dim>
unsigned int ContactDofFace<dim>::normal() const
{
  return axes.is_rotated() ? dim - 1 : axes.axis;
}

template <int dim>
Tensor<1, dim> ContactDofFace<dim>::direction(const unsigned int component) const
{
  Tensor<1, dim> result;
  if (axes.is_rotated())
    result = component == dim - 1 ? axes.normal : axes.tangents[component];
  else
    result[component] = 1;
  return result;
}

template <int dim>
Tensor<1, dim> ContactDofFace<dim>::direction(const unsigned int component,
                                              const unsigned int k) const
{
  if (!is_curved())
    return direction(component);
  return component == dim - 1 ? turning[k].normal : turning[k].tangents[component];
}

template struct ContactDof<2>;
template struct ContactDof<3>;
template struct ContactDofFace<2>;
template struct ContactDofFace<3>;
} // namespace hpvi
