// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/results/warnings/claim.h>

#include <map>

namespace hpvi
{
namespace
{
std::string interval_in_words(const Claim &claim)
{
  return "[" + text(claim.low, 10) + ", " + text(claim.high, 10) + "] " + claim.where;
}
} // namespace

std::string contradiction(const Claims &earlier, const Claims &now)
{
  std::map<std::string, std::vector<const Claim *>> known;
  for (const Claim &claim : earlier)
    known[claim.what].push_back(&claim);
  double farthest = 1.; // in round-offs of both
  std::string words;
  for (const Claim &claim : now)
  {
    std::vector<const Claim *> &others = known[claim.what];
    for (const Claim *const other : others)
    {
      const double apart =
                       claim.low > other->high ? claim.low - other->high : other->low - claim.high,
                   round_off = claim.round_off + other->round_off;
      if (!(apart > farthest * round_off && apart > 0.))
        continue;
      farthest = round_off > 0. ? apart / round_off : apart;
      words = claim.what + " is in " + interval_in_words(*other) + " and in " +
              interval_in_words(claim);
    }
    others.push_back(&claim);
  }
  return words;
}
} // namespace hpvi
