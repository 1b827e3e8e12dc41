// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_probe_table_h
#define hpvi_probe_table_h

#include <hpvi/driver/step_report.h>
#include <hpvi/output/record.h>

#include <string>

namespace hpvi
{
/** The last columns of convergence.csv: half-widths of the resultants of contact, then what probes say. */
template <int dim>
Record probe_record(const StepReport<dim> &step);

/** Its name, as in `probe-NAME-NN.csv`. */
template <int dim>
std::string probe_file(const Scene<dim> &scene, const ProbeLine<dim> &line, unsigned int step);

/** Its rows: the points along one line. */
template <int dim>
std::vector<Record> probe_rows(const ProbeLine<dim> &line);

/** As in "probe tip: at (1, 0)", "probe core: mean over the disc of radius 0.1 mm about (1, 0)"; a line each. */
template <int dim>
std::string probes_in_words(const Scene<dim> &scene);
} // namespace hpvi

#endif
