// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/equilibration_cache.h>

#include <utility>

namespace hpvi
{
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
  drop(macro_elements);
  drop(patches); // whose signatures hold addresses of elements
}
} // namespace hpvi
