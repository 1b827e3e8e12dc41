// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_terminal_h
#define hpvi_terminal_h

#include <hpvi/base/progress.h>
#include <hpvi/base/stage_times.h>

#include <chrono>
#include <string>

namespace hpvi
{
/** As in "hpvi 0.3.0 (Release build), deal.II 9.4.1". */
std::string version_line();

/** Says that results of another scene file are replaced; nothing where @p scene_file is empty. */
std::string replacement_in_words(const std::string &scene_file, const std::string &directory);

/** What could not be printed is no result; @p complete says what is there nonetheless. Throws OutputFailure. */
void check_standard_output(const std::string &complete);

/** Time per stage, summed over the steps. */
void print_stages(const StageTimes &times);

/** What a run is doing, on the last line of a terminal; nothing where standard output is none. */
class ProgressLine
{
public:
  ProgressLine();
  ~ProgressLine();

  void show(const Progress &progress);
  void erase();

private:
  const bool is_terminal;
  bool shown = false;
  bool noted = false;                          ///< a note is worth saying once, not with every step
  std::string words;                           ///< of the stage that is shown, without its numbers
  std::chrono::steady_clock::time_point since; ///< when it was
};
} // namespace hpvi

#endif
