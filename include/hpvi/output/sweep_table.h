// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_sweep_table_h
#define hpvi_sweep_table_h

#include <hpvi/output/record.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * What `sweep.csv` holds: a row per run, whose columns may differ: those of all are there, in the order in which they first
 * come, with empty fields where a run has none. Fields with commas or quotes stand in quotes.
 */
std::string sweep_csv(const std::vector<Record> &runs);

/** The names in its column `directory`; none where it is no such table. */
std::vector<std::string> swept_directories(const std::string &sweep_csv);
} // namespace hpvi

#endif
