// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/thread_pool.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace hpvi
{
namespace
{
/** How long a thread without work looks for some before it sleeps. */
constexpr std::chrono::microseconds longest_look(50);

/** One call of parallel_for(). */
struct Job
{
  const unsigned int n, grain;
  const std::function<void(unsigned int, unsigned int)> &work;
  const Job *const outer; ///< a part of which has begun it; null: none
  unsigned int next = 0, n_at_work = 0;
  unsigned int first_failed = -1; ///< where the part begins that threw
  std::exception_ptr failure{};   ///< what it threw

  bool has_more() const
  {
    return next < n && !failure;
  }

  /** Does @p other wait for it? */
  bool is_inside(const Job *const other) const
  {
    const Job *job = this;
    while (job && job != other)
      job = job->outer;
    return job == other;
  }
};
} // namespace

struct ThreadPool::Workers
{
  std::mutex mutex; ///< of all that follows
  std::condition_variable begun,
      changed;             ///< for those who have nothing to do, and who wait for a job
  std::vector<Job *> jobs; ///< that are not done; those that parts of others have begun come last
  bool is_over = false;
  std::vector<std::thread> threads;
  std::atomic<unsigned int> n_changes{
      0}; ///< jobs begun and parts done; changes with the mutex held

  void tell(std::condition_variable &whom);
  void wait(std::condition_variable &on, std::unique_lock<std::mutex> &lock);
  Job *open_job(const Job *inside) const;
  void take_ranges(Job &of, std::unique_lock<std::mutex> &lock);
  void help();
  void end();
};

namespace
{
thread_local ThreadPool::Workers *serving = nullptr; ///< the calling thread
thread_local bool has_team = false;                  ///< has it one, or is it of one?
thread_local const Job *at_work = nullptr;           ///< whose part it is working on
std::atomic<bool> are_cores_taken(false);            ///< by the thread pool of any thread
} // namespace

void ThreadPool::Workers::tell(std::condition_variable &whom)
{
  ++n_changes;
  whom.notify_all();
}

/** For a change: to sleep and to be woken takes longer than most of what there is to wait for. */
void ThreadPool::Workers::wait(std::condition_variable &on, std::unique_lock<std::mutex> &lock)
{
  const unsigned int before = n_changes;
  lock.unlock();
  const auto end = std::chrono::steady_clock::now() + longest_look;
  while (n_changes == before && std::chrono::steady_clock::now() < end)
    std::this_thread::yield();
  lock.lock();
  if (n_changes == before)
    on.wait(lock);
}

/** The innermost with parts that nobody has taken, of those inside of one; of all, if that is null. Null: none. */
Job *ThreadPool::Workers::open_job(const Job *const inside) const
{
  const auto found =
      std::find_if(jobs.rbegin(), jobs.rend(),
                   [&](const Job *job) { return job->has_more() && job->is_inside(inside); });
  return found == jobs.rend() ? nullptr : *found;
}

/** With the mutex held, but for the work itself. */
void ThreadPool::Workers::take_ranges(Job &of, std::unique_lock<std::mutex> &lock)
{
  const Job *const before = std::exchange(at_work, &of);
  for (++of.n_at_work; of.has_more();)
  {
    const unsigned int begin = of.next, end = of.next + std::min(of.grain, of.n - of.next);
    of.next = end;
    lock.unlock();
    std::exception_ptr thrown;
    try
    {
      of.work(begin, end);
    }
    catch (...)
    {
      thrown = std::current_exception();
    }
    lock.lock();
    if (thrown && begin < of.first_failed)
    {
      of.first_failed = begin;
      of.failure = thrown;
    }
  }
  --of.n_at_work;
  at_work = before;
  tell(changed);
}

void ThreadPool::Workers::help()
{
  const OneThread one_thread;
  has_team = true;
  serving = this;
  std::unique_lock<std::mutex> lock(mutex);
  for (;;)
  {
    while (!is_over && !open_job(nullptr))
      wait(begun, lock);
    if (is_over)
      return;
    take_ranges(*open_job(nullptr), lock);
  }
}

void ThreadPool::Workers::end()
{
  {
    const std::lock_guard<std::mutex> lock(mutex);
    is_over = true;
    tell(begun);
  }
  for (std::thread &thread : threads)
    thread.join();
}

ThreadPool::ThreadPool(const unsigned int n_threads)
{
  if (n_threads < 2 || has_team)
    return;
  workers = std::make_unique<Workers>();
  workers->threads.reserve(n_threads - 1);
  if (are_cores_taken.exchange(true))
  {
    workers.reset();
    return;
  }
  try
  {
    for (unsigned int k = 1; k < n_threads; ++k)
      workers->threads.emplace_back([this]() { workers->help(); });
  }
  catch (const std::system_error &) // those that there are do it all
  {
  }
  serving = workers.get();
  has_team = true;
}

ThreadPool::~ThreadPool()
{
  if (!workers)
    return;
  serving = nullptr;
  has_team = false;
  workers->end();
  are_cores_taken = false;
}

unsigned int pool_size()
{
  return serving ? 1 + serving->threads.size() : 1;
}

void parallel_for(const unsigned int n, const unsigned int grain,
                  const std::function<void(unsigned int, unsigned int)> &work)
{
  if (!serving || n <= grain) // of one part the inner loops may be divided
  {
    for (unsigned int begin = 0; begin < n; begin += std::min(grain, n - begin))
      work(begin, begin + std::min(grain, n - begin));
    return;
  }
  ThreadPool::Workers &workers = *serving;
  Job job{n, grain, work, at_work};
  std::unique_lock<std::mutex> lock(workers.mutex);
  workers.jobs.push_back(&job);
  workers.tell(workers.begun);
  workers.tell(workers.changed);
  workers.take_ranges(job, lock); // the first one without letting others come before
  while (job.n_at_work > 0)
    if (Job *const inner = workers.open_job(&job))
      workers.take_ranges(*inner, lock); // of which those have begun that this waits for
    else
      workers.wait(workers.changed, lock);
  workers.jobs.erase(std::find(workers.jobs.begin(), workers.jobs.end(), &job));
  if (job.failure)
    std::rethrow_exception(job.failure);
}
} // namespace hpvi
