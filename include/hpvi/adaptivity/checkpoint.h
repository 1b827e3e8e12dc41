// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_checkpoint_h
#define hpvi_checkpoint_h

#include <hpvi/backends/backend.h>
#include <hpvi/base/file_format.h>
#include <hpvi/warnings/history.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace hpvi
{
/** All that a run needs to go on after one of its steps, as if it had never stopped, on as many processes as one likes. */
template <int dim>
struct RunState
{
  std::string name; ///< for messages: the file that it comes from
  /** Of the scene: those that decide what the run does; none where code built it: nothing is compared. */
  std::vector<std::string> entries;
  /** From the coarse mesh to that of the step: only their order gives cells the same numbers again. */
  std::vector<Refinement> refinements;
  SolutionValues values; ///< of the step
  History<dim> history;  ///< of the steps up to this one

  /** The entries of @p scene_prm that a state keeps: all but limits, output and labels. */
  static std::vector<std::string> entries_of(const std::string &scene_prm);

  static const FileFormat &format();

  /** All numbers with as many digits as it takes to read them back. */
  void write(std::ostream &out) const;

  /** What write() wrote to a file called @p name. Throws InputError where it is not whole. */
  static RunState read(std::istream &in, const std::string &name);
};
} // namespace hpvi

#endif
