// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_memo_table_h
#define hpvi_memo_table_h

#include <hpvi/base/thread_pool.h>

#include <utility>
#include <vector>

namespace hpvi
{
/** The calling thread may read tables that threads have in common, as long as this lives: it waits for none but those who write. */
class ReadsMemoTables
{
public:
  ReadsMemoTables();
  ~ReadsMemoTables();

  ReadsMemoTables(const ReadsMemoTables &) = delete;
  ReadsMemoTables &operator=(const ReadsMemoTables &) = delete;
};

/** The calling thread alone may read or write them, as long as this lives. */
class WritesMemoTables
{
public:
  WritesMemoTables();
  ~WritesMemoTables();

  WritesMemoTables(const WritesMemoTables &) = delete;
  WritesMemoTables &operator=(const WritesMemoTables &) = delete;
};

/**
 * The value of @p key in a map, `make()` where there is none so far: of a table which threads fill together, and from which nothing is
 * erased meanwhile. Two of them may make the same, of which one is kept; make() may ask for other values.
 */
template <class Map, class Make>
const typename Map::mapped_type &memoised(Map &map, const typename Map::key_type &key,
                                          const Make &make)
{
  {
    const ReadsMemoTables reading;
    if (const auto found = map.find(key); found != map.end())
      return found->second;
  }
  typename Map::mapped_type value = make();
  const WritesMemoTables writing;
  return map.emplace(key, std::move(value)).first->second;
}

/**
 * The values of @p keys in a map, in their order. Where there is none so far, `make(k)` by all threads of the thread pool, k the first place of its
 * key: so it is the same whatever their number. None is left behind where one throws.
 */
template <class Map, class Make>
std::vector<typename Map::mapped_type *>
ordered_values(Map &map, const std::vector<typename Map::key_type> &keys, const Make &make)
{
  std::vector<typename Map::mapped_type *> result;
  std::vector<unsigned int> added;
  for (unsigned int k = 0; k < keys.size(); ++k)
  {
    const auto [found, is_new] = map.try_emplace(keys[k]);
    result.push_back(&found->second);
    if (is_new)
      added.push_back(k);
  }
  try
  {
    parallel_for_each(added.size(), 1,
                      [&](const unsigned int place)
                      { *result[added[place]] = make(added[place]); });
  }
  catch (...)
  {
    for (const unsigned int k : added)
      map.erase(keys[k]);
    throw;
  }
  return result;
}
} // namespace hpvi

#endif
