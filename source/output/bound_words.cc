// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/bound_words.h>

#include <cmath>

namespace hpvi
{
std::string at_most(const double value)
{
  if (!(value > 0) || !std::isfinite(value))
    return text(value, 2);
  const double unit = std::pow(10., std::floor(std::log10(value)) - 1);
  return text(unit * std::ceil(value / unit), 2);
}

std::string error_in_words(const std::string &kind, const std::string &size, const double coupling,
                           const std::string &zones)
{
  const std::string known =
      "if the coupling is at most " + at_most(coupling) + " (estimated; it must be below 2)";
  if (kind == "coupling")
    return "at most " + size + " for every solution of Coulomb's law, bounded " + known;
  if (kind == "zones")
    return "at most " + size + " if " + zones + ", and " + known;
  if (kind == "estimate")
    return "about " + size + ", estimated";
  return "at most " + size + ", guaranteed";
}

std::string terms_in_words(const std::string &kind, const double coupling)
{
  if (kind == "coupling")
    return "bounded, coupling at most " + at_most(coupling);
  if (kind == "zones")
    return "if zones are as said, coupling at most " + at_most(coupling);
  return "guaranteed";
}
} // namespace hpvi
