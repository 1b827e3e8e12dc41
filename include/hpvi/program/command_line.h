// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_command_line_h
#define hpvi_command_line_h

#include <hpvi/reader/input/sweep.h>

#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** What the user asked for. */
struct CommandLine
{
  std::string scene_file;       ///< empty: none named
  std::string output_directory; ///< empty: output/<scene>
  /** `--set "Section/Entry=value"` in the order given: path of the entry, value. */
  std::vector<std::pair<std::string, std::string>> overrides;
  std::vector<SweptEntry> sweeps; ///< `--sweep`: a scene for each combination of their values
  bool resume = false;            ///< go on in output_directory, whose scene.prm is the scene
  std::string report;             ///< the directory of the results to tell of; empty: none
  std::string import;             ///< the deck to make a scene of; empty: none
  bool validate = false;          ///< say what the scene says, write nothing
  bool pdf = false;               ///< of the report, too
  bool picture = false;           ///< draw the scene, solve nothing
  bool inf_sup = false;           ///< measure the inf-sup constant, write nothing
  bool print_parameters = false;
  bool help = false;
  bool version = false;
};

/**
 * Read the arguments of main(). Throws InputError with one line where they make no sense, in
 * particular where a scene is needed and none is named.
 */
CommandLine parse(int argc, const char *const argv[]);

/** The text of `--help`. */
std::string usage();
} // namespace hpvi

#endif
