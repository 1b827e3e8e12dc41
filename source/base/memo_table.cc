// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/memo_table.h>

#include <array>
#include <atomic>
#include <mutex>

namespace hpvi
{
namespace
{
/**
 * Readers lock one of these each, in a part of memory that other cores seldom touch: one lock for all would go from core to core at
 * each of some fifty values that a cell asks for. A writer, a few hundred times in a run, locks them all.
 */
struct alignas(128) Lock
{
  std::mutex mutex;
};
std::array<Lock, 64> locks;
std::atomic<unsigned int> n_readers(0);

Lock &own_lock()
{
  thread_local const unsigned int number = n_readers++;
  return locks[number % locks.size()];
}
} // namespace

ReadsMemoTables::ReadsMemoTables()
{
  own_lock().mutex.lock();
}

ReadsMemoTables::~ReadsMemoTables()
{
  own_lock().mutex.unlock();
}

WritesMemoTables::WritesMemoTables()
{
  for (Lock &lock : locks)
    lock.mutex.lock();
}

WritesMemoTables::~WritesMemoTables()
{
  for (Lock &lock : locks)
    lock.mutex.unlock();
}
} // namespace hpvi
