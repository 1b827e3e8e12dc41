// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_disjoint_sets_h
#define hpvi_disjoint_sets_h

#include <algorithm>
#include <numeric>
#include <vector>

namespace hpvi
{
/** Sets of the numbers from 0 to n-1, each of its own at first, joined where they have something in common. */
class DisjointSets
{
public:
  explicit DisjointSets(const unsigned int n) : parent(n)
  {
    std::iota(parent.begin(), parent.end(), 0);
  }

  /** The least number of the set of @p k. */
  unsigned int root(unsigned int k)
  {
    while (parent[k] != k)
      k = parent[k] = parent[parent[k]];
    return k;
  }

  void join(const unsigned int a, const unsigned int b)
  {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent[high] = low;
  }

  unsigned int n_sets() const
  {
    unsigned int n = 0;
    for (unsigned int k = 0; k < parent.size(); ++k)
      n += parent[k] == k;
    return n;
  }

private:
  std::vector<unsigned int> parent;
};
} // namespace hpvi

#endif
