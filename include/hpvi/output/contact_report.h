// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_report_h
#define hpvi_contact_report_h

#include <hpvi/results/contact_state.h>
#include <hpvi/results/equilibrium.h>
#include <hpvi/results/stress_singularity.h>

#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * A point of the line along which the force of @p boundary acts, `(x - c) x F = M` with the moment M
 * about @p centre: where it meets the contact edge, or nearest to c where it is parallel to it. Null where
 * there is no force beyond round-off beside @p scale [stress length^(dim-1)].
 */
template <int dim>
std::optional<dealii::Point<dim>> line_of_action(const BoundaryForce<dim> &boundary,
                                                 const dealii::Point<dim> &centre,
                                                 const ContactState<dim> &contact, double scale);

/**
 * What each contact boundary and each support does to the body, in words, line by line; stresses without
 * bound are named as such.
 */
template <int dim>
std::string contact_in_words(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                             const Equilibrium<dim> &equilibrium,
                             const std::vector<StressSingularity<dim>> &unbounded);

/** The contact boundaries as the object of JSON with their names. */
template <int dim>
std::string contact_json(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                         const Equilibrium<dim> &equilibrium,
                         const std::vector<StressSingularity<dim>> &unbounded);

/** von Mises' stress as an object of JSON: the largest value, where, and which peaks are unbounded. */
template <int dim>
std::string von_mises_json(const std::vector<StressSample<dim>> &extrema,
                           const std::vector<StressSingularity<dim>> &unbounded);

/** Of each plate its mean point, how that moves and turns, and the moment about it: an object of JSON. */
template <int dim>
std::string plates_json(const Scene<dim> &scene, const Equilibrium<dim> &equilibrium);

/** Forces and moments of the loads and by boundary, an object of JSON. */
template <int dim>
std::string forces_json(const Equilibrium<dim> &equilibrium);

/** How well they balance, likewise. */
template <int dim>
std::string balance_json(const Equilibrium<dim> &equilibrium);

/** The resultant of all loads of a scene, of a history those of its first load step: a line before the first step. */
std::string loads_in_words(const Scene<2> &scene);

/** The same of the step at hand as an object of JSON; null before there is one. */
std::string loads_json(const std::optional<LoadSum> &loads);

/** A point or vector as an array of JSON. */
template <int dim>
std::string json_point(const dealii::Tensor<1, dim> &x);
} // namespace hpvi

#endif
