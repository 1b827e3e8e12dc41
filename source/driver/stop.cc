// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/driver/stop.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <ostream>

namespace hpvi
{
namespace
{
/** In the order of the enumerators of Stop. */
const std::string stop_words[] = {"",
                                  "round-off",
                                  "Tolerance",
                                  "Maximum steps",
                                  "Maximum unknowns",
                                  "Maximum seconds",
                                  "Maximum degree",
                                  "hap threshold",
                                  "hpa1 bisected fraction",
                                  "hpa2 marked fraction",
                                  "hpa3 threshold",
                                  "Adapt = first step",
                                  "error of load step "};
} // namespace

std::string text(const StopReason &reason)
{
  return stop_words[static_cast<unsigned int>(reason.stop)] +
         (reason.stop == Stop::load_step ? std::to_string(reason.load_step) : "");
}

std::ostream &operator<<(std::ostream &out, const StopReason &reason)
{
  return out << text(reason);
}

StopReason stop_reason_from(const std::string &words)
{
  const std::size_t number = std::min(words.find_last_not_of("0123456789") + 1, words.size());
  const auto found =
      std::find(std::begin(stop_words), std::end(stop_words), words.substr(0, number));
  if (found == std::end(stop_words))
    return {};
  return {static_cast<Stop>(found - std::begin(stop_words)),
          static_cast<unsigned int>(std::strtoul(words.c_str() + number, nullptr, 10))};
}
} // namespace hpvi
