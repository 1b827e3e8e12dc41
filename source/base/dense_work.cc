// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/dense_work.h>
#include <hpvi/base/memory.h>

#include <algorithm>
#include <sstream>

namespace hpvi
{
double DenseWork::bytes() const
{
  const double c = n_contact, m = n_multipliers;
  return sizeof(double) * (c * m + std::max(c * c + m * m, 3 * m * m));
}

double DenseWork::seconds() const
{
  const double c = n_contact, m = n_multipliers;
  return (c * c * c / 3 + c * c * m + c * m * m + m * m * m / 3) / 2e10;
}

std::string DenseWork::name() const
{
  return "the dense algebra of " + std::to_string(n_multipliers) + " multipliers";
}

std::string DenseWork::note() const
{
  if (seconds() < 1)
    return {};
  std::ostringstream line;
  line.precision(2);
  line << name() << " takes " << bytes_text(bytes()) << " and about " << seconds()
       << " s in a step; take fewer Geometry/Subdivisions along the contact boundary, or a method "
          "that refines where it must";
  return line.str();
}
} // namespace hpvi
