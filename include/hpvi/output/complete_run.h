// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_complete_run_h
#define hpvi_complete_run_h

#include <hpvi/scene/scene.h>

#include <filesystem>
#include <string>
#include <vector>

namespace hpvi
{
/** Does summary.json in @p directory say that this version of the program is done there? */
bool is_complete_run(const std::filesystem::path &directory);

/** Of each mesh file, and of the reference solution, its entry and what is in it: "Geometry/File = content checksum 0a1b2c3d". */
template <int dim>
std::vector<std::string> input_files_of(const Scene<dim> &scene);

/** Those that summary.json in @p directory has. */
std::vector<std::string> input_files_of(const std::filesystem::path &directory);
} // namespace hpvi

#endif
