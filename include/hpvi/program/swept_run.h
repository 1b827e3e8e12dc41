// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_swept_run_h
#define hpvi_swept_run_h

#include <hpvi/output/summary.h>
#include <hpvi/scene/scene.h>

#include <cstddef>
#include <string>
#include <vector>

namespace hpvi
{
/** How one run of a sweep stands. */
struct SweptRun
{
  RunStatus status = RunStatus::not_begun;
  std::string message; ///< why it failed
  std::vector<std::string> warnings;
  double seconds = 0;
  bool was_done = false;           ///< by an earlier sweep
  bool is_short_of_memory = false; ///< why it failed
  bool was_postponed = false;      ///< for it was, beside others

  /** As run() does alone, on the calling thread. Throws nothing: what goes wrong is the status. */
  template <int dim>
  static SweptRun solved(const Scene<dim> &scene, const std::string &directory);

  /** For standard output, in columns below head(): @p name, status, energy, unknowns, seconds, what it warns of. */
  std::string line(const std::string &name, std::size_t width, const Record &last_row) const;
  static std::string head(std::size_t width);
};

/** Of the signal that asks all to end; 0: none does. */
int interrupting_signal();
} // namespace hpvi

#endif
