// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_user_names_h
#define hpvi_user_names_h

#include <hpvi/base/parameter_file.h>

#include <string>
#include <vector>

namespace hpvi
{
/** Of sections that a scene has beside those of all scenes, in the order of the file. */
struct UserNames
{
  std::vector<std::string> parts;     ///< `Boundary NAME` that says On which side it lies
  std::vector<std::string> materials; ///< `Material NAME`
  std::vector<std::string> sides = {"left", "right", "bottom",
                                    "top"}; ///< of the body, by boundary id: each has a section
  bool is_from_file = false; ///< is the mesh one of a file, whose edges may follow curves?
  std::vector<std::string> interfaces = {};  ///< of such a mesh, curves inside
  std::vector<std::string> bodies = {};      ///< `Body NAME`
  std::vector<std::string> pairs = {};       ///< `Contact NAME`
  std::vector<std::string> probes = {};      ///< `Probe NAME`
  std::vector<std::string> pretensions = {}; ///< `Pretension NAME`
};

/** The bodies that @p all open; of one body none. Throws as user_names(). */
std::vector<std::string> body_names(const std::vector<Assignment> &all);

/**
 * What @p all open. Throws InputError for names of other
 * than letters, digits, '_', '-' and blanks, and for two that differ in case alone.
 */
UserNames user_names(const std::vector<Assignment> &all, const std::vector<std::string> &sides);
} // namespace hpvi

#endif
