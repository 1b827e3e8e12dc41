// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_thickness_h
#define hpvi_thickness_h

#include <hpvi/driver/step_report.h>

namespace hpvi
{
/**
 * Everything is solved and decided for a body of unit thickness. What a step reports is for Scene::thickness b:
 * energies and forces times b, norms and bounds of the error times b^(1/2); tractions and relative numbers stay.
 */
template <int dim>
void take_thickness(StepReport<dim> &step);
} // namespace hpvi

#endif
