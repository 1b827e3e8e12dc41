// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_started_processes_h
#define hpvi_started_processes_h

#include <functional>

namespace hpvi
{
/** Has a launcher of MPI said that it starts several processes? To be asked before MPI starts, which takes its time. */
bool may_have_company();

unsigned int n_started_processes(); ///< 1 while MPI does not run
bool is_first_process();

/** collectively(), of all processes where MPI runs. */
void in_all_processes(const std::function<void()> &work);
} // namespace hpvi

#endif
