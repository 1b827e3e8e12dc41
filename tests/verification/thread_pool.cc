// SPDX-License-Identifier: LGPL-2.1-or-later
// Threads that share loops, and the tables that they fill together.
#include "../texts.h"

#include <gtest/gtest.h>
#include <hpvi/base/memo_table.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/thread_pool.h>

#include <atomic>
#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace
{
using namespace hpvi;

TEST(ThreadPool, DoesAllWorkOnce)
{
  for (const unsigned int n_threads : {1U, 2U, 5U})
  {
    const ThreadPool pool(n_threads);
    EXPECT_EQ(pool_size(), n_threads);
    for (const unsigned int n : {0U, 1U, 7U, 1000U})
      for (const unsigned int grain : {1U, 3U, 2000U})
      {
        std::vector<unsigned int> times(n, 0);
        parallel_for_each(n, grain, [&](const unsigned int k) { ++times[k]; });
        EXPECT_EQ(times, std::vector<unsigned int>(n, 1));
      }
  }
  EXPECT_EQ(pool_size(), 1U);
}

/** It is several threads that work. */
TEST(ThreadPool, WorksTogether)
{
  const ThreadPool pool(3);
  const ThreadPool none(7); // the outer one serves
  EXPECT_EQ(pool_size(), 3U);
  std::atomic<unsigned int> n_there(0);
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  parallel_for_each(3, 1,
                    [&](unsigned int)
                    {
                      const ThreadPool of_a_part(2);
                      EXPECT_EQ(pool_size(), 3U);
                      ++n_there;
                      while (n_there < 3 && std::chrono::steady_clock::now() < patience)
                        std::this_thread::yield();
                    });
  EXPECT_EQ(n_there, 3U);
  EXPECT_TRUE(std::chrono::steady_clock::now() < patience); // else one after the other
}

/** Who has done a part, or waits for it, helps with what is inside of another: none of these would end without. */
TEST(ThreadPool, HelpsInsideOfParts)
{
  const ThreadPool pool(3);
  for (unsigned int repetition = 0; repetition < 40; ++repetition)
  {
    const unsigned int idle = repetition % 2; // the calling thread's part, or another
    std::atomic<unsigned int> n_there(0), n_done(0);
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    parallel_for_each(2, 1,
                      [&](const unsigned int part)
                      {
                        if (part == idle)
                          return parallel_for_each(30, 2, [&](unsigned int) { ++n_done; });
                        parallel_for_each(
                            3, 1,
                            [&](unsigned int)
                            {
                              ++n_there;
                              while (n_there < 3 && std::chrono::steady_clock::now() < patience)
                                std::this_thread::yield();
                              parallel_for_each(10, 1, [&](unsigned int) { ++n_done; });
                            });
                      });
    EXPECT_EQ(n_there, 3U);
    EXPECT_EQ(n_done, 60U);
    ASSERT_TRUE(std::chrono::steady_clock::now() < patience); // else one after the other
    const std::string failure = failure_of<NumericalFailure>(
        [&]
        {
          parallel_for_each(4, 1,
                            [&](const unsigned int part)
                            {
                              parallel_for_each(9, 1,
                                                [&](const unsigned int k)
                                                {
                                                  if (part >= 2 && k >= 3)
                                                    throw NumericalFailure(std::to_string(part) +
                                                                           std::to_string(k));
                                                });
                            });
        });
    EXPECT_EQ(failure, "23");
  }
}

/** Two threads do not share the cores twice. */
TEST(ThreadPool, IsOneAtATime)
{
  const ThreadPool pool(2);
  std::thread other(
      []()
      {
        const ThreadPool another(2);
        EXPECT_EQ(pool_size(), 1U);
        unsigned int sum = 0;
        parallel_for_each(100, 1, [&](const unsigned int k) { sum += k; });
        EXPECT_EQ(sum, 4950U);
      });
  other.join();
  EXPECT_EQ(pool_size(), 2U);
}

/** Whoever is first to throw, what the first part in order has thrown goes on; then it works as before. */
TEST(ThreadPool, ThrowsWhatTheFirstThrew)
{
  for (const unsigned int n_threads : {1U, 2U, 3U})
  {
    const ThreadPool pool(n_threads);
    for (unsigned int repetition = 0; repetition < 50; ++repetition)
    {
      const auto work = [&](const unsigned int k)
      {
        if (k == 11)
          std::this_thread::yield();
        if (k == 11 || k == 12 || k == 17)
          throw NumericalFailure("part " + std::to_string(k));
      };
      EXPECT_EQ(failure_of<NumericalFailure>([&] { parallel_for_each(40, 1, work); }), "part 11");
    }
    unsigned int sum = 0;
    parallel_for_each(1, 1, [&](unsigned int) { ++sum; });
    EXPECT_EQ(sum, 1U);
  }
}

TEST(CommonTable, MakesWhatIsMissing)
{
  const ThreadPool pool(3);
  std::map<unsigned int, double> squares;
  parallel_for_each(2000, 7,
                    [&](const unsigned int k)
                    {
                      const unsigned int key = k % 50;
                      EXPECT_EQ(memoised(squares, key, [&]() { return double(key) * key; }),
                                key * key);
                    });
  EXPECT_EQ(squares.size(), 50U);
}

/** By the first place of each key; and none is left where making one fails. */
TEST(CommonTable, KeepsTheOrder)
{
  const std::vector<unsigned int> keys = {3, 1, 3, 2, 1, 5};
  for (const unsigned int n_threads : {1U, 3U})
  {
    const ThreadPool pool(n_threads);
    std::map<unsigned int, unsigned int> places = {{2, 77}};
    const auto values = ordered_values(places, keys, [](const unsigned int k) { return k; });
    const std::vector<unsigned int> expected = {0, 1, 0, 77, 1, 5};
    for (unsigned int k = 0; k < keys.size(); ++k)
      EXPECT_EQ(*values[k], expected[k]);
    std::map<unsigned int, unsigned int> others = {{2, 77}};
    EXPECT_THROW(ordered_values(others, keys,
                                [](const unsigned int k) -> unsigned int
                                {
                                  if (k == 5)
                                    throw NumericalFailure("no");
                                  return k;
                                }),
                 NumericalFailure);
    EXPECT_EQ(others.size(), 1U);
  }
}
} // namespace
