// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/cores.h>

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace hpvi
{
unsigned int n_usable_cores()
{
  cpu_set_t set;
  CPU_ZERO(&set);
  const int n = sched_getaffinity(0, sizeof(set), &set) == 0 ? CPU_COUNT(&set) : 0;
  // A machine with more than a set has room for is asked in the other way.
  return std::max(1u, n > 0 ? n : std::thread::hardware_concurrency());
}

void on_threads(const unsigned int n_threads, const unsigned int n,
                const std::function<void(unsigned int)> &work)
{
  std::vector<std::exception_ptr> failures(n);
  std::atomic<unsigned int> next(0);
  const auto take = [&]()
  {
    for (unsigned int k = next++; k < n; k = next++)
      try
      {
        work(k);
      }
      catch (...)
      {
        failures[k] = std::current_exception();
      }
  };
  std::vector<std::thread> threads;
  try
  {
    for (unsigned int k = 0; n_threads > 1 && k < std::min(n_threads, n); ++k)
      threads.emplace_back(take);
  }
  catch (const std::system_error &) // those that there are do it all
  {
  }
  if (threads.empty())
    take();
  for (std::thread &thread : threads)
    thread.join();
  for (const std::exception_ptr &failure : failures)
    if (failure)
      std::rethrow_exception(failure);
}
} // namespace hpvi
