// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_input_error_h
#define hpvi_input_error_h

#include <stdexcept>

namespace hpvi
{
/**
 * Bad input: what() is one line with file, entry, value and remedy. The program ends with exit
 * status 1.
 */
class InputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};
} // namespace hpvi

#endif
