// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_forces_table_h
#define hpvi_forces_table_h

#include <hpvi/driver/step_report.h>
#include <hpvi/output/record.h>

#include <vector>

namespace hpvi
{
/** The rows of forces.csv of one step: of each boundary, part of a side and side of a pair what it exerts on the body. */
template <int dim>
std::vector<Record> forces_rows(const StepReport<dim> &step);

/** The last columns of loading.csv: where each boundary is held or moved to, as a mean over its coarse edges or faces. */
template <int dim>
Record prescribed_displacements(const StepReport<dim> &step);
} // namespace hpvi

#endif
