// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_finished_run_h
#define hpvi_finished_run_h

#include <filesystem>

namespace hpvi
{
/** Does summary.json in @p directory say that this version of the program is done there? */
bool is_finished_run(const std::filesystem::path &directory);
} // namespace hpvi

#endif
