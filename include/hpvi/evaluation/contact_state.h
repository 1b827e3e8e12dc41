// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_state_h
#define hpvi_contact_state_h

#include <hpvi/discretisation/solution.h>

#include <vector>

namespace hpvi
{
/** What u_N, z_N do at one Gauss point of the contact boundary. */
template <int dim>
struct ContactPoint
{
  unsigned int q; ///< its number on the face, in the order of the face's reference coordinate
  dealii::Point<dim> x;
  double friction_bound; ///< g [stress], 0 on a face without multipliers
  double lambda;         ///< z_N/g, 0 where g is
  bool slips;            ///< |lambda| = 1 or g = 0
};

/** The Gauss points of a face's multiplier (one point where that has none), along the tangent. */
template <int dim>
std::vector<ContactPoint<dim>> contact_points(const ContactFace<dim> &face,
                                              const Solution<dim> &solution);

/**
 * Where u_N changes between stick and slip or turns its slip around: halfway between neighbouring
 * Gauss points of one contact boundary whose states differ. Boundary by boundary, along the tangent.
 */
template <int dim>
std::vector<dealii::Point<dim>> transitions(const Solution<dim> &solution);
} // namespace hpvi

#endif
