// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_tests_overrides_h
#define hpvi_tests_overrides_h

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

/** Entries of a scene and their values. */
using Overrides = std::vector<std::pair<std::string, std::string>>;

/** @p entries and @p more, whose values count where both have an entry. */
inline Overrides with(Overrides entries, const Overrides &more)
{
  for (const auto &entry : more)
  {
    entries.erase(std::remove_if(entries.begin(), entries.end(),
                                 [&](const auto &known) { return known.first == entry.first; }),
                  entries.end());
    entries.push_back(entry);
  }
  return entries;
}

inline Overrides operator+(const Overrides &entries, const Overrides &more)
{
  return with(entries, more);
}

inline Overrides joined(const std::vector<Overrides> &all)
{
  Overrides result;
  for (const Overrides &some : all)
    result = with(result, some);
  return result;
}

#endif
