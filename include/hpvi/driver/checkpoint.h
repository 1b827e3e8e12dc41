// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_checkpoint_h
#define hpvi_checkpoint_h

#include <hpvi/base/file_format.h>
#include <hpvi/driver/backend.h>
#include <hpvi/driver/finished_loads.h>
#include <hpvi/results/warnings/history.h>

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * All that a run needs to go on after one of its steps, of a history of loads after one of its load steps, as if it had
 * never stopped, on as many processes as one likes.
 */
template <int dim>
struct RunState
{
  std::string name; ///< for messages: the file that it comes from
  /** Of the scene: those that decide what the run does; none where code built it: nothing is compared. */
  std::vector<std::string> entries;
  /**
   * From the coarse mesh to that of the step: only their order gives cells the same numbers again. Those of
   * Backend::discretise() follow from them, and stand here in a history of loads alone.
   */
  std::vector<MeshMarks> refinements;
  SolutionValues values; ///< of the step
  History<dim>
      history; ///< of the steps up to this one, in a history of loads those of the load step
  std::optional<FinishedLoads> loads; ///< of a history of loads

  /** The steps of the run up to this one. */
  unsigned int n_steps() const
  {
    return loads ? loads->n_steps : history.size();
  }

  /** Throws InputError with what differs where it is not one of @p scene, limits, output and labels aside. */
  void require_scene(const Scene<dim> &scene, unsigned int n_processes) const;

  /** Those of @p scene that a state keeps, all but limits, output and labels, with the path that it takes on @p n_processes. */
  static std::vector<std::string> entries_of(const Scene<dim> &scene, unsigned int n_processes);

  static const FileFormat &format();

  /** All numbers so that they read back as they are. */
  void write(std::ostream &out) const;

  /** What write() wrote to a file called @p name. Throws InputError where it is not whole. */
  static RunState read(std::istream &in, const std::string &name);
};
} // namespace hpvi

#endif
