// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_numbers_h
#define hpvi_numbers_h

#include <deal.II/base/types.h>

#include <limits>

namespace hpvi
{
/** What is beyond all numbers, as the side that an interval has not. */
constexpr double infinity = std::numeric_limits<double>::infinity();

/** The index of what is not there. */
constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
} // namespace hpvi

#endif
