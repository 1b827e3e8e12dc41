// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_tables_h
#define hpvi_tables_h

#include <hpvi/adaptivity/step_report.h>
#include <hpvi/output/record.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * The tables with a row per step: what `convergence.csv` and `degrees.csv` hold; and `loading.csv` with a
 * row per load step of a history.
 */
template <int dim>
class Tables
{
public:
  void add(const StepReport<dim> &step);

  const Record &last_row() const; ///< of convergence()
  std::string convergence() const;
  std::string degrees() const;
  std::string loading() const;

private:
  std::vector<Record> rows;
  std::vector<std::vector<unsigned int>> elements; ///< by step and degree
  std::vector<Record> load_steps;
};

/** Name and seconds of every stage. */
Record stage_record(const StageTimes &times);
} // namespace hpvi

#endif
