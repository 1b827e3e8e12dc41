// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_pretension_report_h
#define hpvi_pretension_report_h

#include <hpvi/driver/step_report.h>

#include <string>

namespace hpvi
{
/** Of each cut through a bolt what the scene says, line by line. */
template <int dim>
std::string pretensions_in_words(const Scene<dim> &scene);

/** Of each its force and shortening in a step that ends a run, line by line. */
template <int dim>
std::string pretensions_in_words(const StepReport<dim> &step);

/** The same as an object of JSON. */
template <int dim>
std::string pretensions_json(const StepReport<dim> &step);
} // namespace hpvi

#endif
