// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_conclusion_h
#define hpvi_conclusion_h

#include <hpvi/driver/step_report.h>
#include <hpvi/results/warnings/history.h>

namespace hpvi
{
/** The rest of the report of a step after which none comes, the last one of @p history. Collective. */
template <int dim>
void conclude(const Backend<dim> &backend, const History<dim> &history, StepReport<dim> &step);
} // namespace hpvi

#endif
