// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_parameter_file_h
#define hpvi_parameter_file_h

#include <string>
#include <utility>
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
 * The assignments of a file in deal.II's parameter syntax, in its order, and after them those of the command line: read
 * once, for all who ask. An assignment without name stands for the opening of its section. ParameterHandler could read the
 * same text, but it neither tells the line of a wrong value nor misses an `end` where it is due.
 */
struct ParameterFile
{
  /** @p overrides are pairs "Section/Entry", value. Without a @p name they are all that there is. Throws InputError. */
  explicit ParameterFile(const std::string &name,
                         const std::vector<std::pair<std::string, std::string>> &overrides = {});

  const std::string name; ///< as the user wrote it
  std::vector<Assignment> assignments;
};

/** @p text without what no parameter file can hold: '#', line breaks, a backslash at the end. */
std::string storable(std::string text);

/**
 * The one line about bad input: @p what is the entry with its value, or the statement. Names what hides in it, like a
 * no-break space.
 */
[[noreturn]] void fail(const std::string &where, const std::string &what,
                       const std::string &problem_and_remedy);
} // namespace hpvi

#endif
