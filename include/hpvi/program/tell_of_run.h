// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_tell_of_run_h
#define hpvi_tell_of_run_h

#include <string>

namespace hpvi
{
/** `hpvi --report`: report() as report.html into @p directory, and where it is. Throws InputError or OutputFailure. */
void tell_of_run(const std::string &directory);
} // namespace hpvi

#endif
