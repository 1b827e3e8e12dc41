// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_warnings_h
#define hpvi_warnings_h

#include <hpvi/adaptivity/history.h>
#include <hpvi/discretisation/iterative_refinement.h>
#include <hpvi/discretisation/solution.h>
#include <hpvi/evaluation/contact_state.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * What in a result asks for care, one line each with its numbers and a remedy: tensile normal
 * traction of bilateral contact, |lambda_N| above 1 between Gauss points, transitions that are not
 * resolved, round-off that reaches the digits shown, an indicator that stagnates or rises, elongated elements, corners near 0 or 180 degrees, low degree where Poisson's ratio
 * is near 1/2, a multiplier that is too rich, a body that slips as a whole, strains, rotations and slip that are not small, a friction bound that jumps
 * inside an edge, steps of @p history whose table lacks a condition number.
 */
template <int dim>
std::vector<std::string> warnings(const Solution<dim> &solution,
                                  const std::vector<ContactState<dim>> &contact,
                                  const History &history, const AlgebraicError &algebraic);

/** Where a second start was asked for: that it led to another solution, or to none; else empty. */
std::string several_solutions(const CoulombReport &report);

/**
 * That a body penetrates its foundation by more than 1 % of what it deforms, Deformation::largest(); else
 * empty. Rigid motions of the whole scene do not change the verdict.
 */
template <int dim>
std::string deep_penetration(const Scene<dim> &scene, dealii::types::boundary_id boundary,
                             double depth, const dealii::Point<dim> &where, double deformation);

/** That of the friction `int |T_t|`, @p all, more than 1 % acts where unilateral contact is open; else empty. */
std::string friction_without_contact(double open, double all);

/** That a bound from 1e-12 to 1e-9 of the solution holds up to round-off, and how much that is; else empty. */
std::string round_off_of_bound(double relative, double imbalance);
} // namespace hpvi

#endif
