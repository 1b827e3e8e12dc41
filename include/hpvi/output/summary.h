// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_summary_h
#define hpvi_summary_h

#include <hpvi/driver/step_report.h>
#include <hpvi/output/record.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** How a run ended, or stands. */
enum class RunStatus
{
  not_begun, ///< of a sweep
  running,
  done,
  failed,
  interrupted,
  refused ///< of a sweep: bad input
};

/** As in files. */
std::string text(RunStatus status);

/**
 * How a run stands: what `summary.json` says beside the scene. Its members are the same on each path and
 * whatever the outcome; what there is not, not yet or not on this path is null.
 */
struct Summary
{
  RunStatus status = RunStatus::running;
  std::string message;                  ///< why it failed or was interrupted
  StopReason stopped_by;                ///< of the last step
  std::string linear;                   ///< what solved the linear systems of the primal path
  std::string scene_file;               ///< of a run that goes on: the file with which it began
  std::vector<std::string> input_files; ///< that the scene names, with their content
  unsigned int processes = 1;
  unsigned int steps = 0; ///< finished ones
  Record last_row;        ///< of the last of them in convergence.csv
  StageTimes times;       ///< sums over them
  std::vector<std::string> warnings;
  /** As JSON, of the last step of this load step that has one, whatever ends the run. */
  std::string last_error_bound = "null", contradiction; ///< StepReport::contradiction
  unsigned int load_step = 0;                           ///< that of the last step
  LoadStep load;                                        ///< the last one that is done, of a history
  std::optional<LoadSum> loads;                         ///< of the last step, in the plane

  /** Of the last step, where stopped_by names what ended the run; what there is not is null. */
  JsonMembers ending;

  /** Begin with steps of convergence.csv that are finished, and the last row of loading.csv. */
  void take_up(const std::vector<Record> &rows, const Record &last_load);

  /** Count a finished step, whose row is @p row. */
  template <int dim>
  void add(const StepReport<dim> &step, const Record &row);

  /** With the names of the program's own @p files. */
  template <int dim>
  std::string json(const Scene<dim> &scene, const std::vector<std::string> &files) const;
};

/** Does summary.json in @p directory say that this version of the program is done there? */
bool is_complete_run(const std::filesystem::path &directory);

/** Of each mesh file, and of the reference solution, its entry and what is in it: "Geometry/File = content checksum 0a1b2c3d". */
template <int dim>
std::vector<std::string> input_files_of(const Scene<dim> &scene);

/** Those that summary.json in @p directory has. */
std::vector<std::string> input_files_of(const std::filesystem::path &directory);
} // namespace hpvi

#endif
