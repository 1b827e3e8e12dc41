// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_numerical_failure_h
#define hpvi_numerical_failure_h

#include <cmath>
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

/** What overflows must not pass for a result: throws NumericalFailure that names it. */
inline void check_finite(const char *const name, const double value)
{
  if (!std::isfinite(value))
    throw NumericalFailure(std::string(name) + " is not finite: numbers overflow or elements are "
                                               "degenerate; choose units in which loads, Friction "
                                               "bound and Young's modulus are moderate");
}
} // namespace hpvi

#endif
