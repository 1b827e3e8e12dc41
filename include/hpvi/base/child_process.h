// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_child_process_h
#define hpvi_child_process_h

#include <string>
#include <vector>

namespace hpvi
{
/** What became of another program. */
struct ChildEnd
{
  std::string output;   ///< what it wrote to its standard output
  int status = 0;       ///< with which it ended by itself
  int signal = 0;       ///< that has ended it; 0: none
  bool is_late = false; ///< has it been ended because its time was over?
};

/**
 * Run the program @p command.front(), for at most so many seconds, and then end it with all that it has started. It reads
 * nothing, and what it says of errors is dropped. Throws InputError where it cannot be started.
 */
ChildEnd run_child(const std::vector<std::string> &command, double seconds);
} // namespace hpvi

#endif
