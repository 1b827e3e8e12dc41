// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_finite_h
#define hpvi_finite_h

#include <hpvi/base/numerical_failure.h>

#include <cmath>
#include <string>

namespace hpvi
{
/** Of numbers up to @p size: do their products overflow, or is what is none, 0/0, none in all units? */
inline bool overflows(const double size)
{
  return size > 1e100;
}

/** What is not finite must not pass for a result: throws NumericalFailure that names it, made of numbers up to @p size. */
inline void check_finite(const char *const name, const double value, const double size)
{
  if (!std::isfinite(value))
    throw NumericalFailure(
        std::string(name) + " is not finite: " +
        (std::isinf(value) || overflows(size)
             ? "numbers overflow; choose units in which loads, Friction bound and Young's modulus "
               "are moderate"
             : "it is no number, as 0 divided by 0; look for cells without area and edges without "
               "length"));
}
} // namespace hpvi

#endif
