// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_column_width_h
#define hpvi_column_width_h

#include <hpvi/driver/step_report.h>

#include <string>

namespace hpvi
{
/**
 * What is measured by a column of convergence.csv that may have a `_bound` beside it; null: there is no such one in this step.
 * A resultant of contact is that of the only contact boundary, or of the first side of the only pair.
 */
template <int dim>
const Measured *measured_in(const StepReport<dim> &step, const std::string &column);

/**
 * The half-width of Adaptivity::tolerance_column, about its value in the table, over that value; of a probe as a whole the
 * largest of its components over the length of its displacement. NaN where there is none.
 */
template <int dim>
double relative_half_width(const StepReport<dim> &step);

/** Why that is NaN. */
template <int dim>
std::string no_half_width(const StepReport<dim> &step);
} // namespace hpvi

#endif
