// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_warnings_h
#define hpvi_warnings_h

#include <hpvi/plane/iterative_refinement.h>
#include <hpvi/plane/solution.h>
#include <hpvi/results/contact_state.h>
#include <hpvi/results/warnings/body_state.h>
#include <hpvi/results/warnings/history.h>

#include <string>
#include <vector>

namespace hpvi
{
/** What a warning is about, in the order in which they are said. */
enum class WarningKind
{
  contradiction,     ///< of guaranteed intervals
  tension,           ///< bilateral contact pulls
  overshoot,         ///< |lambda_N| above 1 between Gauss points
  pulling_pressure,  ///< unilateral contact pulls between the points of its multiplier
  penetration,       ///< deep beside the deformation
  gap_slope,         ///< of two bodies, where they press
  no_contact,        ///< anywhere, in space
  bare_joint,        ///< of two bodies that lie on each other, and no pair has them
  transition,        ///< open, stick, slip change on a coarse edge
  open_friction,     ///< friction without contact
  stagnation,        ///< of the indicator
  rise,              ///< likewise
  load_step,         ///< of a history, has a large indicator
  dissipation,       ///< depends on the number of load steps
  unseen_contact,    ///< between points that nothing presses
  unseen_gap,        ///< between the points of the contact conditions
  round_off,         ///< reaches the digits shown
  elongation,        ///< of cells
  corners,           ///< of the body near 0 or 180 degrees
  strain,            ///< is not small
  rotation,          ///< likewise
  slip,              ///< likewise
  locking,           ///< low degree where Poisson's ratio is near 1/2
  rich_multiplier,   ///< no inf-sup condition
  sliding_body,      ///< its place is not unique
  free_body,         ///< likewise, with unilateral contact
  bound,             ///< of friction, varies inside an edge
  bound_jump,        ///< likewise
  coefficient,       ///< of friction, varies inside an edge
  coefficient_jump,  ///< likewise
  friction_law,      ///< of both, its limit varies inside an edge
  load,              ///< is not resolved
  displacement,      ///< lies between the nodes
  condition_number,  ///< is missing
  no_interval,       ///< of a number on which there is a tolerance
  several_solutions, ///< of Coulomb friction
  dense_work,        ///< takes long
  bound_round_off,   ///< holds up to round-off alone
  cut_off,           ///< Newton's method gave up
  multigrid,         ///< likewise
  unsteady           ///< cycles of a history go on to change
};

/** What in a result asks for care: a line with its numbers and a remedy. */
struct Warning
{
  WarningKind kind;
  double size; ///< how bad, to compare with others of the same kind
  std::string text;
};

using Warnings = std::vector<Warning>;

/** All of them, one after the other. */
template <class... Parts>
Warnings joined(const Parts &...parts)
{
  Warnings result;
  (result.insert(result.end(), parts.begin(), parts.end()), ...);
  return result;
}

/** Their lines, by kind. */
std::vector<std::string> texts(const Warnings &warnings);

/**
 * Adds @p found, each with the @p place where it was, as in "load step 3, t = 0.15", to @p worst, where
 * each kind stands once, with the largest size.
 */
void keep_worst(Warnings &worst, const Warnings &found, const std::string &place);

/**
 * What there is to say of any solution in space or in the plane, whatever found it. @p contact and @p body are
 * those of the last step of @p history.
 */
template <int dim>
Warnings warnings(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                  const BodyState<dim> &body, const History<dim> &history);

/** Of it: what contact does along the normal. */
template <int dim>
Warnings contact_warnings(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                          const BodyState<dim> &body);

/** Of it: friction and slip. */
template <int dim>
Warnings friction_warnings(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact);

/** Of it: cells, corners, strains and rotations. */
template <int dim>
Warnings mesh_warnings(const Scene<dim> &scene, const BodyState<dim> &body);

/** Of it: what steps say together. */
template <int dim>
Warnings history_warnings(const Scene<dim> &scene, const History<dim> &history);

/**
 * What the reduced path alone can say of its multiplier, the sum of forces and the algebra: overshoot and
 * transitions, bodies whose place is not unique, round-off, several solutions of Coulomb friction.
 */
template <int dim>
Warnings multiplier_warnings(const Solution<dim> &solution,
                             const std::vector<ContactState<dim>> &contact,
                             const AlgebraicError &algebraic, const CoulombReport &coulomb);

/** Of it: where a second start was asked for, that it led to another solution, or to none. */
Warnings several_solutions(const CoulombReport &report);

/** What its mesh does not see: contact, gaps, bounds of friction, loads and displacements between the points of rules. */
template <int dim>
Warnings unseen_warnings(const Solution<dim> &solution);

/** That Adaptivity::tolerance_column has no half-width, NaN, because of @p no_interval; none: it has. */
Warnings tolerance_warnings(const Adaptivity &adaptivity, double relative_half_width,
                            const std::string &no_interval);

/** That guaranteed intervals do not meet, contradiction() in words; or none. */
Warnings contradiction_warnings(const std::string &contradiction);

/** Likewise, as the reason why a step has no bound. */
std::string no_guarantee(const std::string &contradiction);
/** Of a load step that is over: that @p relative_estimate, its relative indicator, is above a tenth; or none. */
Warnings load_step_warnings(double relative_estimate);

/**
 * Of a history that is over: that friction dissipates @p at_ends by its values at the end of each load step, @p trapezoidal by the
 * trapezoidal rule, and that they differ by more than a twentieth of the larger; or none, also where both are below 1e-6 of
 * @p energy, which was turned over.
 */
Warnings dissipation_warnings(double at_ends, double trapezoidal, double energy);

/** Of a history that is over: that its last cycle differs from the one before by a share @p change, more than @p asked_for. */
Warnings steady_warnings(double change, double asked_for);

/** That a bound from 1e-12 to 1e-9 of the solution holds up to round-off, and how much that is; or none. */
Warnings bound_warnings(double relative, double imbalance);
} // namespace hpvi

#endif
