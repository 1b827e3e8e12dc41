// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/contact_axes.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The unit vector along @p e without its part along @p n. */
Tensor<1, 3> across(const Tensor<1, 3> &n, const unsigned int axis)
{
  Tensor<1, 3> e;
  e[axis] = 1;
  e -= (e * n) * n;
  return e / e.norm();
}
} // namespace

template <int dim>
ContactAxes<dim> contact_axes(const Tensor<1, dim> &normal)
{
  ContactAxes<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
  {
    Tensor<1, dim> rest = normal;
    rest[d] = 0;
    if (rest.norm() < 1e-10)
      result.axis = d;
  }
  if (!result.is_rotated())
  {
    result.normal[result.axis] = normal[result.axis] > 0 ? 1 : -1;
    for (unsigned int d = 0, s = 0; d < dim; ++d)
      if (d != result.axis)
        result.tangents[s++][d] = 1;
    return result;
  }
  result.normal = normal / normal.norm();
  if constexpr (dim == 2)
    result.tangents[0] = -cross_product_2d(result.normal);
  else
  {
    // The first axis that is far from the normal; no normal of rational numbers is at the border, where round-off would choose.
    unsigned int axis = 0;
    while (std::abs(result.normal[axis]) > 0.6180339887)
      ++axis;
    result.tangents[0] = across(result.normal, axis);
    result.tangents[1] = cross_product_3d(result.normal, result.tangents[0]);
  }
  return result;
}

template struct ContactAxes<2>;
template struct ContactAxes<3>;
template ContactAxes<2> contact_axes(const Tensor<1, 2> &);
template ContactAxes<3> contact_axes(const Tensor<1, 3> &);
} // namespace hpvi
