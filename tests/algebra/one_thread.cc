// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>
#include <hpvi/base/one_thread.h>

#include <cstdlib>
#include <future>
#include <optional>
#include <string>
#include <thread>

// Present where OpenBLAS is the BLAS in use and where CHOLMOD was built with OpenMP.
extern "C"
{
  char *openblas_get_corename() __attribute__((weak));
  int openblas_get_num_threads() __attribute__((weak));
  void openblas_set_num_threads(int) __attribute__((weak));
  int omp_get_max_active_levels() __attribute__((weak));
  void omp_set_max_active_levels(int) __attribute__((weak));
  int omp_get_max_threads() __attribute__((weak));
  void omp_set_num_threads(int) __attribute__((weak));
}

namespace
{
using hpvi::OneThread;

/** Numbers that neither the libraries nor a guard would choose. */
class OneThreadTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    if (!openblas_set_num_threads || !omp_set_max_active_levels)
      GTEST_SKIP() << "neither OpenBLAS nor OpenMP";
    openblas_set_num_threads(3);
    omp_set_max_active_levels(5);
    omp_set_num_threads(7);
  }

  static void expect_one()
  {
    EXPECT_EQ(openblas_get_num_threads(), 1);
    EXPECT_EQ(omp_get_max_active_levels(), 0);
    EXPECT_EQ(omp_get_max_threads(), 1);
  }

  static void expect_restored()
  {
    EXPECT_EQ(openblas_get_num_threads(), 3);
    EXPECT_EQ(omp_get_max_active_levels(), 5);
    EXPECT_EQ(omp_get_max_threads(), 7);
  }
};

#ifdef __x86_64__
/** A processor that OpenBLAS does not know is no Prescott. */
TEST(KernelsOfOpenBlas, AreThoseOfThisProcessor)
{
  if (!openblas_get_corename || std::getenv("OPENBLAS_CORETYPE") || !__builtin_cpu_supports("avx2"))
    GTEST_SKIP() << "they are chosen, or there are no better ones";
  EXPECT_NE(openblas_get_corename(), std::string("Prescott"));
}
#endif

TEST_F(OneThreadTest, LastsAsLongAsTheGuard)
{
  {
    const OneThread guard;
    expect_one();
    {
      const OneThread within;
      expect_one();
    }
    expect_one();
  }
  expect_restored();
}

/** The first to come is the first to leave: the other still has one thread. */
TEST_F(OneThreadTest, LastsAsLongAsAnyThreadHoldsAGuard)
{
  std::optional<OneThread> first;
  first.emplace();
  std::promise<void> inside, may_leave;
  std::thread other(
      [&]
      {
        omp_set_max_active_levels(4);
        omp_set_num_threads(6);
        {
          const OneThread second;
          expect_one();
          inside.set_value();
          may_leave.get_future().wait();
          expect_one();
        }
        EXPECT_EQ(omp_get_max_active_levels(), 4);
        EXPECT_EQ(omp_get_max_threads(), 6);
      });
  inside.get_future().wait();
  first.reset();
  EXPECT_EQ(openblas_get_num_threads(), 1);
  EXPECT_EQ(omp_get_max_active_levels(), 5);
  EXPECT_EQ(omp_get_max_threads(), 7);
  may_leave.set_value();
  other.join();
  expect_restored();
}
} // namespace
