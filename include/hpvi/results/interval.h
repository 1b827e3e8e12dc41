// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_interval_h
#define hpvi_interval_h

#include <cmath>
#include <limits>
#include <optional>

namespace hpvi
{
/** In which a number of the exact solution lies, guaranteed or bounded as BoundKind of its step says: `|number - centre| <= half_width`. */
struct Interval
{
  double centre = 0, half_width = 0;
};

/** A number of the discrete solution, and where that of the exact one lies, if that is known. */
struct Measured
{
  double value = std::numeric_limits<double>::quiet_NaN(); ///< NaN: there is none
  std::optional<Interval> interval = std::nullopt; ///< its centre is a better value than @p value

  /** The best that is known. */
  double best() const
  {
    return interval ? interval->centre : value;
  }

  /** Half the width of an interval about @p other that holds the one that is known; NaN: none is. */
  double half_width_about(const double other) const
  {
    return interval ? interval->half_width + std::abs(interval->centre - other)
                    : std::numeric_limits<double>::quiet_NaN();
  }

  /** As of a body @p factor times as thick. */
  void multiply(const double factor)
  {
    value *= factor;
    if (interval)
      interval = Interval{factor * interval->centre, factor * interval->half_width};
  }
};
} // namespace hpvi

#endif
