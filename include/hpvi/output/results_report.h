// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_results_report_h
#define hpvi_results_report_h

#include <hpvi/driver/step_report.h>

#include <string>

namespace hpvi
{
/**
 * As in "-8.78716 +- 0.00021": the half-width has two digits, and so much is added to it that what rounding takes from the
 * centre is in it.
 */
std::string interval_in_words(const Interval &interval);

/**
 * What engineers read of the last step, in words, line by line: guaranteed intervals of forces, what probes say, the largest
 * displacement and von Mises' stress; one that is unbounded is contact_in_words()'s.
 */
template <int dim>
std::string results_in_words(const StepReport<dim> &step);
} // namespace hpvi

#endif
