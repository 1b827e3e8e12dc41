// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_report_tables_h
#define hpvi_report_tables_h

#include <hpvi/output/run_files.h>
#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/** Forces and moments on each boundary with their guaranteed intervals, how well they balance, what became of loads. HTML, as all that follows. */
template <int dim>
std::string forces_words(const Scene<dim> &scene, const RunFiles &files);

/** A row for each step, of many the first and the last ones. */
std::string steps_table(const RunFiles &files);

/** Each with its remedy, as the run said it. */
std::string warnings_list(const JsonTree &summary);

/** All that differs between equal runs, on one line. */
std::string times_line(const JsonTree &summary);
} // namespace hpvi

#endif
