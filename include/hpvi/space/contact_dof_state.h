// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_dof_state_h
#define hpvi_contact_dof_state_h

#include <deal.II/base/symmetric_tensor.h>

namespace hpvi
{
/** What Newton's method makes of a contact dof of the contact: no motion, or a stiffness H. */
template <int dim>
struct ContactDofState
{
  bool is_held = false; ///< it sticks, or a pressure acts
  dealii::SymmetricTensor<2, dim - 1> stiffness;
};
} // namespace hpvi

#endif
