// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/output/chart_axes.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
std::vector<double> tick_marks(const double lower, const double upper, const double maximum)
{
  const double wanted = (upper - lower) / maximum;
  const double decade = std::pow(10., std::floor(std::log10(wanted)));
  double spacing = 10 * decade;
  for (const double factor : {5., 2., 1.})
    if (factor * decade >= wanted)
      spacing = factor * decade;
  std::vector<double> marks;
  const double slack = unseen_in_picture * (upper - lower);
  for (double k = std::ceil((lower - slack) / spacing); k * spacing <= upper + slack; ++k)
    marks.push_back(k * spacing + 0.); // never -0
  return marks;
}

double axis_offset(const double lower, const double upper)
{
  if (std::max(std::abs(lower), std::abs(upper)) < 1e4 * (upper - lower))
    return 0;
  const double unit = std::pow(10., std::ceil(std::log10(upper - lower)) + 1);
  return unit * std::floor(lower / unit);
}

std::string axis_label(const std::string &coordinate, const double offset, const std::string &unit)
{
  const std::string difference =
      offset == 0 ? "" : (offset > 0 ? " - " : " + ") + text(std::abs(offset), 15);
  return coordinate + difference + (unit.empty() ? "" : " [" + unit + "]");
}
} // namespace hpvi
