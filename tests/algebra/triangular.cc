// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>
#include <hpvi/algebra/triangular.h>

#include <cmath>
#include <random>
#include <vector>

namespace
{
using hpvi::PackedTriangle;

/** L of a random matrix that is far from singular, by columns; zeros above the diagonal. */
std::vector<double> random_factor(const unsigned int n)
{
  std::mt19937 random(n);
  std::uniform_real_distribution<double> entries(-1., 1.);
  std::vector<double> L(n * n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = j; i < n; ++i)
      L[j * n + i] = i == j ? 2. + entries(random) : entries(random) / std::sqrt(n);
  return L;
}

double product(const unsigned int n, const std::vector<double> &L, const unsigned int i,
               const unsigned int j)
{
  double sum = 0;
  for (unsigned int k = 0; k <= std::min(i, j); ++k)
    sum += L[k * n + i] * L[k * n + j];
  return sum;
}

/** Sizes on both sides of a panel of eight or sixteen columns, and where LAPACK takes over. */
class Triangle : public ::testing::TestWithParam<unsigned int>
{
protected:
  const unsigned int n = GetParam(), stride = n + 3;
  const std::vector<double> L = random_factor(n);

  /** L L' in the lower triangle of a larger square. */
  std::vector<double> square() const
  {
    std::vector<double> A(stride * n, 1e30);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = j; i < n; ++i)
        A[j * stride + i] = product(n, L, i, j);
    return A;
  }

  PackedTriangle packed() const
  {
    PackedTriangle A(n);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = j; i < n; ++i)
        A.column(j)[i] = product(n, L, i, j);
    return A;
  }

  /** op(L) of columns of 1, 2, ... with rows that are not to change between them. */
  std::vector<double> right(const char op, const unsigned int columns) const
  {
    std::vector<double> B(stride * columns, 7.);
    for (unsigned int k = 0; k < columns; ++k)
      for (unsigned int i = 0; i < n; ++i)
      {
        B[k * stride + i] = 0;
        for (unsigned int j = 0; j < n; ++j)
          B[k * stride + i] += (op == 'N' ? L[j * n + i] : L[i * n + j]) * (1. + j + k);
      }
    return B;
  }

  void expect_solution(const std::vector<double> &B, const unsigned int columns) const
  {
    for (unsigned int k = 0; k < columns; ++k)
      for (unsigned int i = 0; i < stride; ++i)
        ASSERT_NEAR(B[k * stride + i], i < n ? 1. + i + k : 7., 1e-12 * stride) << i << " " << k;
  }
};

TEST_P(Triangle, IsFactored)
{
  std::vector<double> A = square();
  ASSERT_TRUE(hpvi::cholesky(n, A.data(), stride));
  PackedTriangle P = packed();
  ASSERT_TRUE(P.factor());
  EXPECT_EQ(P.size(), n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = j; i < n; ++i)
    {
      ASSERT_NEAR(A[j * stride + i], L[j * n + i], 1e-13) << i << " " << j;
      ASSERT_NEAR(P.column(j)[i], L[j * n + i], 1e-13) << i << " " << j;
    }
  for (unsigned int j = 0; j < n; ++j) // below the columns
    for (unsigned int i = n; i < stride; ++i)
      EXPECT_EQ(A[j * stride + i], 1e30);
}

TEST_P(Triangle, IsSolved)
{
  std::vector<double> A = square();
  ASSERT_TRUE(hpvi::cholesky(n, A.data(), stride));
  PackedTriangle P = packed();
  ASSERT_TRUE(P.factor());
  for (const char op : {'N', 'T'})
    for (const unsigned int columns : {0U, 1U, 2U, 21U})
    {
      std::vector<double> B = right(op, columns);
      hpvi::solve_triangular(op, n, columns, {A.data(), stride}, B.data(), stride);
      expect_solution(B, columns);
      if (op == 'T' && columns != 1)
        continue;
      B = right(op, columns);
      P.solve(op, columns, B.data(), stride);
      expect_solution(B, columns);
    }
}

/** At each place that a panel may have. */
TEST_P(Triangle, IsRefusedUnlessPositiveDefinite)
{
  for (unsigned int bad = 0; bad < n; bad += bad < 20 ? 1 : 13)
    for (const double pivot : {-1e-3, 0., std::nan("")})
    {
      std::vector<double> A = square();
      PackedTriangle P = packed();
      // What is left of the diagonal is the square of L's.
      const double entry = product(n, L, bad, bad) - std::pow(L[bad * n + bad], 2) + pivot;
      A[bad * stride + bad] = P.column(bad)[bad] = pivot == 0. ? entry - 1e-12 : entry;
      EXPECT_FALSE(hpvi::cholesky(n, A.data(), stride)) << bad;
      EXPECT_FALSE(P.factor()) << bad;
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Triangle,
                         ::testing::Values(0U, 1U, 7U, 8U, 9U, 16U, 17U, 31U, 48U, 160U, 161U));
} // namespace
