// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_chart_axes_h
#define hpvi_chart_axes_h

#include <string>
#include <vector>

namespace hpvi
{
/** Marks at multiples of 1, 2 or 5 times a power of ten, at most @p maximum of them or so. */
std::vector<double> tick_marks(double lower, double upper, double maximum);

/** What to subtract from coordinates whose differences six digits would not show; else 0. */
double axis_offset(double lower, double upper);

/** As in "x - 1000000 [mm]": a coordinate, the offset its numbers are relative to, the unit. */
std::string axis_label(const std::string &coordinate, double offset, const std::string &unit);
} // namespace hpvi

#endif
