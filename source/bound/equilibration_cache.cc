// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/memo_table.h>
#include <hpvi/bound/equilibration_cache.h>

#include <utility>

namespace hpvi
{
const RowTable &EquilibrationCache::row_table(const unsigned int degree, const unsigned int n_gauss,
                                              const unsigned int marked_corners)
{
  return memoised(row_tables, {{degree, n_gauss, marked_corners}},
                  [&]() { return RowTable(degree, n_gauss, marked_corners); });
}

void EquilibrationCache::drop_unused()
{
  const auto drop = [](auto &map)
  {
    for (auto entry = map.begin(); entry != map.end();)
      if (std::exchange(entry->second.is_used, false))
        ++entry;
      else
        entry = map.erase(entry);
  };
  // Signatures of those below hold addresses of those above.
  drop(row_elements);
  drop(cut_elements);
  drop(patches);
}
} // namespace hpvi
