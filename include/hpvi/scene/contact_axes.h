// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_axes_h
#define hpvi_contact_axes_h

#include <deal.II/base/numbers.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace hpvi
{
/** Orthonormal directions of a plane face, which depend on its normal alone: children of a face have those of their parent. */
template <int dim>
struct ContactAxes
{
  static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

  dealii::Tensor<1, dim> normal; ///< outwards
  std::array<dealii::Tensor<1, dim>, dim - 1>
      tangents; ///< where the normal is along an axis, the others in rising order
  unsigned int axis =
      none; ///< of coordinates that the normal is along, to 1e-10; none: it is along none

  bool is_rotated() const
  {
    return axis == none;
  }
};

/** Of a face with this outer unit normal. */
template <int dim>
ContactAxes<dim> contact_axes(const dealii::Tensor<1, dim> &normal);
} // namespace hpvi

#endif
