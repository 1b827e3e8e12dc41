// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_unseen_contact_h
#define hpvi_unseen_contact_h

#include <hpvi/plane/displacement_cuts.h>
#include <hpvi/plane/solution.h>
#include <hpvi/results/field.h>

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

/** How far u_N moves the nodes of the body, its nearest rigid motion aside [length]. Collective. */
template <int dim>
double deformation(const Field<dim> &field);

/** A place where the contact conditions of an edge stand for another gap than the scene's. */
template <int dim>
struct UnseenGap
{
  const ContactFace<dim> *face;
  dealii::Point<dim> where; ///< where both differ most
  double gap;               ///< u_0 there [length]
  double seen;              ///< the polynomial through u_0 at the points of the conditions
};

/**
 * Of each face with unilateral contact on which the gap and the polynomial that the discrete conditions
 * see of it, through the Gauss-Lobatto points of nodes or the points of a multiplier's moments, differ
 * by more than 1e-3 of the deformation where u_N reaches the nearer of both. Edges below 1e-6
 * of the body are left alone: a jump inside an edge is never followed. 128 samples an edge.
 */
template <int dim>
std::vector<UnseenGap<dim>> unseen_gaps(const Solution<dim> &solution);

/**
 * @p missed without gaps that nobody closes, however they vary: those beyond three times the largest displacement, and those of masters, as the
 * points of their slaves alone ask for the gap of a pair.
 */
template <int dim>
std::vector<MissedDisplacement<dim>> within_reach(std::vector<MissedDisplacement<dim>> missed,
                                                  const Solution<dim> &solution);
} // namespace hpvi

#endif
