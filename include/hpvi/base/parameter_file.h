// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_parameter_file_h
#define hpvi_parameter_file_h

#include <string>
#include <vector>

namespace hpvi
{
/** `set name = value` with the section it stands in and the place that messages name. */
struct Assignment
{
  std::string section, name, value;
  std::string where; ///< FILE:LINE, or FILE (--set)
};

/**
 * The assignments of a file in deal.II's parameter syntax, in its order; an assignment without
 * name stands for the opening of its section. ParameterHandler could read the same text, but it
 * neither tells the line of a wrong value nor misses an `end` where it is due.
 */
std::vector<Assignment> read_parameter_file(const std::string &file);

/**
 * The one line about bad input: @p what is the entry with its value, or the statement. Names what hides in it, like a
 * no-break space.
 */
[[noreturn]] void fail(const std::string &where, const std::string &what,
                       const std::string &problem_and_remedy);
} // namespace hpvi

#endif
