// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_unseen_contact_h
#define hpvi_unseen_contact_h

#include <hpvi/discretisation/solution.h>

#include <vector>

namespace hpvi
{
/** A place where u_N passes through the foundation and no multiplier is near enough to notice. */
template <int dim>
struct UnseenContact
{
  const ContactFace<dim> *face;
  dealii::Point<dim> where; ///< of the largest u_n - u_0 there
  double depth;             ///< u_n - u_0 [length]
};

/**
 * Of each face with unilateral contact on which, as on its neighbours, nothing presses: contact may be
 * so much smaller than an edge that it lies between the points of the multiplier, while the indicator
 * falls. Maxima of u_n - u_0 are sought between samples (Brent), to 1e-10 of the displacement.
 */
template <int dim>
std::vector<UnseenContact<dim>> unseen_contacts(const Solution<dim> &solution);
} // namespace hpvi

#endif
