// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_numerical_failure_h
#define hpvi_numerical_failure_h

#include <stdexcept>
#include <string>

namespace hpvi
{
/** The numerics gave up: what() is one line that says where and why. Exit status 2. */
class NumericalFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};
} // namespace hpvi

#endif
