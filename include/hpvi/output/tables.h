// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_tables_h
#define hpvi_tables_h

#include <hpvi/driver/finished_loads.h>
#include <hpvi/driver/step_report.h>
#include <hpvi/output/record.h>

#include <functional>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * The tables with a row per step: what `convergence.csv` and `degrees.csv` hold; `forces.csv` with a row per boundary
 * of each; and `loading.csv` with a row per load step of a history. They grow at their ends, unless a new degree asks for
 * a new column.
 */
template <int dim>
class Tables
{
public:
  void add(const StepReport<dim> &step);

  /**
   * Begins with the rows of the first @p n_steps steps of what files hold, as they stand there, the last of them the end of a load
   * step where there @p is_history; returns those of convergence. Throws InputError where they are not all there.
   */
  std::vector<Record> take_up(unsigned int n_steps, bool is_history,
                              const std::function<std::string(const std::string &)> &content_of);

  GrowingTable convergence, degrees, forces, loading; ///< the files of these names

private:
  void add_degrees();

  std::vector<std::vector<dealii::types::global_dof_index>> elements; ///< by step and degree
  std::size_t n_columns = 0; ///< the highest degree so far and 1
};

/** Rows of `cycles.csv`. */
std::vector<Record> cycle_rows(const std::vector<LoadCycle> &cycles);

/** Name and seconds of every stage. */
Record stage_record(const StageTimes &times);
} // namespace hpvi

#endif
