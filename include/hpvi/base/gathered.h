// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_gathered_h
#define hpvi_gathered_h

#include <hpvi/base/processes.h>

#include <numeric>
#include <type_traits>
#include <vector>

namespace hpvi
{
/**
 * The items of all processes, in turn, on each of them. Utilities::MPI::all_gather() would compress them, also on one process, which
 * takes longer than all else. Collective.
 */
template <class Item>
std::vector<Item> gathered(const std::vector<Item> &own, MPI_Comm communicator)
{
  static_assert(std::is_trivially_copyable_v<Item>, "Items go as their bytes.");
  const unsigned int n = n_processes(communicator);
  if (n == 1)
    return own;
  std::vector<int> counts(n), first(n);
  const int count = own.size();
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
  std::partial_sum(counts.begin(), counts.end() - 1, first.begin() + 1);
  std::vector<Item> all(first.back() + counts.back());
  MPI_Datatype item;
  MPI_Type_contiguous(sizeof(Item), MPI_BYTE, &item);
  MPI_Type_commit(&item);
  MPI_Allgatherv(own.data(), count, item, all.data(), counts.data(), first.data(), item,
                 communicator);
  MPI_Type_free(&item);
  return all;
}
} // namespace hpvi

#endif
