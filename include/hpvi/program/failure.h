// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_failure_h
#define hpvi_failure_h

#include <exception>
#include <string>

namespace hpvi
{
/** Is it one of those that a run may end with? Others are errors of the program. */
bool is_foreseen(const std::exception &error);

/** May it go better where others leave more memory? */
bool is_out_of_memory(const std::exception &error);

/** The one line for stderr. */
std::string failure_line(const std::exception &error);

/** 1 for bad input, 2 where the numerics or the machine gave up, 128 + signal when interrupted. */
int exit_status(const std::exception &error);
} // namespace hpvi

#endif
