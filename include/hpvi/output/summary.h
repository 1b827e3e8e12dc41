// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_summary_h
#define hpvi_summary_h

#include <hpvi/adaptivity/step_report.h>
#include <hpvi/output/record.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace hpvi
{
/** How a run stands: what `summary.json` says beside the scene. */
template <int dim>
struct Summary
{
  std::string status = "running"; ///< later "done", "failed", "interrupted"
  std::string message;            ///< why it failed or was interrupted
  unsigned int steps = 0;         ///< finished ones
  Record last_row;                ///< of the last of them in convergence.csv
  StageTimes times;               ///< sums over them
  std::string stopped_by;         ///< the limit that ended the run
  std::vector<std::string> warnings;
  std::vector<ContactState<dim>> contact;      ///< of the last step
  std::vector<StressSample<dim>> peaks;        ///< likewise
  std::vector<UnboundedStress<dim>> unbounded; ///< likewise
  Equilibrium<dim> equilibrium; ///< of the last step, where stopped_by names what ended the run

  std::optional<ErrorBound> bound; ///< of the last step
  std::string no_bound;            ///< why there is none
  double relative_bound = 0;
  double energy = 0;            ///< J(u_N), likewise
  LoadStep load;                ///< the last one that is done, of a history
  std::optional<LoadSum> loads; ///< of the last step

  /** Count a finished step, whose row is @p row. */
  void add(const StepReport<dim> &step, const Record &row);

  /** With the names of the program's own @p files. */
  std::string json(const Scene<dim> &scene, const std::set<std::string> &files) const;

private:
  std::string json_bound() const;
};

/** What summary.json begins with on each path: how the run stands, what it solves and with which program. */
template <int dim>
std::string json_head(const Scene<dim> &scene, const std::string &status,
                      const std::string &stopped_by, const std::string &message);

/** What it ends with. */
std::string json_tail(const StageTimes &times, const std::vector<std::string> &warnings,
                      const std::set<std::string> &files);
} // namespace hpvi

#endif
