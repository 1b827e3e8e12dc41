// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_line_h
#define hpvi_line_h

#include <sstream>
#include <string>

namespace hpvi
{
/** Text made of numbers with three digits. */
template <class... Parts>
std::string line(const Parts &...parts)
{
  std::ostringstream out;
  out.precision(3);
  (out << ... << parts);
  return out.str();
}

/** A number with its unit, unless that is 1. */
inline std::string labelled(const double value, const std::string &unit)
{
  return unit.empty() || unit == "1" ? line(value) : line(value, " ", unit);
}
} // namespace hpvi

#endif
