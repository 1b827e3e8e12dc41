// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_report_h
#define hpvi_contact_report_h

#include <hpvi/driver/step_report.h>
#include <hpvi/output/record.h>

#include <optional>
#include <string>

namespace hpvi
{
/**
 * What each contact boundary and each support does to the body, in words, line by line; stresses without
 * bound are named as such.
 */
template <int dim>
std::string contact_in_words(const StepReport<dim> &step);

/**
 * The same as members of JSON: "forces" and moments of the loads and by boundary, their "balance", each "contact" boundary, the largest
 * "von_mises" stress with the peaks that are unbounded, and of each of "plates", if there are any, how it moves and turns.
 */
template <int dim>
JsonMembers contact_members(const StepReport<dim> &step);

/** The resultant of all loads of a scene, of a history those of its first load step: a line before the first step. */
std::string loads_in_words(const Scene<2> &scene);

/** The same of the step at hand as an object of JSON; null before there is one. */
std::string loads_json(const std::optional<LoadSum> &loads);

/** The largest von Mises' stress of a step. */
template <int dim>
const StressSample<dim> &largest_von_mises(const StepReport<dim> &step);

/** A point or vector as an array of JSON. */
template <int dim>
std::string json_point(const dealii::Tensor<1, dim> &x);
} // namespace hpvi

#endif
