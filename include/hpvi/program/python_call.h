// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_python_call_h
#define hpvi_python_call_h

#include <string>
#include <vector>

namespace hpvi
{
/**
 * Let hpvi's package of Python do what it is told, by Debian's Python alone: an environment that is active, or variables of it, do not
 * matter. @p what: as in "report", for messages; @p words: the command of hpvi/__main__.py. Throws OutputFailure, one line with the
 * package that is missing or what went wrong.
 */
void call_python(const std::string &what, const std::vector<std::string> &words);
} // namespace hpvi

#endif
