// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/team.h>

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

/** One call of in_parts(). */
struct Job
{
  const unsigned int n, at_once;
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

struct Team::Crew
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
  void take_parts(Job &of, std::unique_lock<std::mutex> &lock);
  void help();
  void end();
};

namespace
{
thread_local Team::Crew *serving = nullptr; ///< the calling thread
thread_local bool has_team = false;         ///< has it one, or is it of one?
thread_local const Job *at_work = nullptr;  ///< whose part it is working on
std::atomic<bool> are_cores_taken(false);   ///< by the team of any thread
} // namespace

void Team::Crew::tell(std::condition_variable &whom)
{
  ++n_changes;
  whom.notify_all();
}

/** For a change: to sleep and to be woken takes longer than most of what there is to wait for. */
void Team::Crew::wait(std::condition_variable &on, std::unique_lock<std::mutex> &lock)
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
Job *Team::Crew::open_job(const Job *const inside) const
{
  const auto found =
      std::find_if(jobs.rbegin(), jobs.rend(),
                   [&](const Job *job) { return job->has_more() && job->is_inside(inside); });
  return found == jobs.rend() ? nullptr : *found;
}

/** With the mutex held, but for the work itself. */
void Team::Crew::take_parts(Job &of, std::unique_lock<std::mutex> &lock)
{
  const Job *const before = std::exchange(at_work, &of);
  for (++of.n_at_work; of.has_more();)
  {
    const unsigned int begin = of.next, end = of.next + std::min(of.at_once, of.n - of.next);
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

void Team::Crew::help()
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
    take_parts(*open_job(nullptr), lock);
  }
}

void Team::Crew::end()
{
  {
    const std::lock_guard<std::mutex> lock(mutex);
    is_over = true;
    tell(begun);
  }
  for (std::thread &thread : threads)
    thread.join();
}

Team::Team(const unsigned int n_threads)
{
  if (n_threads < 2 || has_team)
    return;
  crew = std::make_unique<Crew>();
  crew->threads.reserve(n_threads - 1);
  if (are_cores_taken.exchange(true))
  {
    crew.reset();
    return;
  }
  try
  {
    for (unsigned int k = 1; k < n_threads; ++k)
      crew->threads.emplace_back([this]() { crew->help(); });
  }
  catch (const std::system_error &) // those that there are do it all
  {
  }
  serving = crew.get();
  has_team = true;
}

Team::~Team()
{
  if (!crew)
    return;
  serving = nullptr;
  has_team = false;
  crew->end();
  are_cores_taken = false;
}

unsigned int team_size()
{
  return serving ? 1 + serving->threads.size() : 1;
}

void in_parts(const unsigned int n, const unsigned int at_once,
              const std::function<void(unsigned int, unsigned int)> &work)
{
  if (!serving || n <= at_once) // of one part the inner loops may be divided
  {
    for (unsigned int begin = 0; begin < n; begin += std::min(at_once, n - begin))
      work(begin, begin + std::min(at_once, n - begin));
    return;
  }
  Team::Crew &crew = *serving;
  Job job{n, at_once, work, at_work};
  std::unique_lock<std::mutex> lock(crew.mutex);
  crew.jobs.push_back(&job);
  crew.tell(crew.begun);
  crew.tell(crew.changed);
  crew.take_parts(job, lock); // the first one without letting others come before
  while (job.n_at_work > 0)
    if (Job *const inner = crew.open_job(&job))
      crew.take_parts(*inner, lock); // of which those have begun that this waits for
    else
      crew.wait(crew.changed, lock);
  crew.jobs.erase(std::find(crew.jobs.begin(), crew.jobs.end(), &job));
  if (job.failure)
    std::rethrow_exception(job.failure);
}
} // namespace hpvi
