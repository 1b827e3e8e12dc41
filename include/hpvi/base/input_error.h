// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_input_error_h
#define hpvi_input_error_h

#include <stdexcept>
#include <string>

namespace hpvi
{
/**
 * Bad input: what() is one line with file, entry, value and remedy. The program ends with exit
 * status 1.
 */
class InputError : public std::runtime_error
{
public:
  explicit InputError(const std::string &line, const bool names_time = false)
      : std::runtime_error(line), names_time(names_time)
  {
  }

  bool names_time; ///< at which it is so, of a load history
};
} // namespace hpvi

#endif
