// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_thread_pool_h
#define hpvi_thread_pool_h

#include <hpvi/base/one_thread.h>

#include <functional>
#include <memory>

namespace hpvi
{
/**
 * Threads that help the one which makes this with parallel_for(), as long as this lives. Each has dense algebra on one thread.
 * A thread pool that is made where there is one already, or by one of its threads, has none of its own: the outer one serves. There is one at a time in a
 * process: where several threads make thread pools, the others work alone meanwhile.
 */
class ThreadPool
{
public:
  /** @p n_threads: the calling one among them; fewer where the system gives no more. */
  explicit ThreadPool(unsigned int n_threads);
  ~ThreadPool();

  ThreadPool(const ThreadPool &) = delete;
  ThreadPool &operator=(const ThreadPool &) = delete;

  struct Workers;

private:
  const OneThread one_thread;
  std::unique_ptr<Workers> workers;
};

/** Of the thread pool that serves the calling thread, itself among them; 1 without one. */
unsigned int pool_size();

/**
 * work(begin, end) for parts of 0, ..., n - 1 that follow on one another, each of @p grain, the last of what is left; by all threads of the
 * thread pool, each taking the first part that is left, the calling one the very first. A part may call it, too: whoever has nothing to do helps,
 * and so does whoever waits for that part.
 * Parts do not depend on the number of threads: where results of one part do not depend on another, nothing does. Throws what the first of
 * all parts that threw has thrown; parts behind it may not have been worked on.
 */
void parallel_for(unsigned int n, unsigned int grain,
                  const std::function<void(unsigned int begin, unsigned int end)> &work);

/** work(k) for k = 0, ..., n - 1, likewise. */
template <class Work>
void parallel_for_each(const unsigned int n, const unsigned int grain, const Work &work)
{
  parallel_for(n, grain,
               [&work](const unsigned int begin, const unsigned int end)
               {
                 for (unsigned int k = begin; k < end; ++k)
                   work(k);
               });
}
} // namespace hpvi

#endif
