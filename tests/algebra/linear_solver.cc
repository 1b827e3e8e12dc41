// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../texts.h"
#include "memory.h"

#include <gtest/gtest.h>
#include <hpvi/algebra/linear_solver.h>
#include <hpvi/base/numerical_failure.h>

#include <memory>
#include <new>
#include <numeric>
#include <string>
#include <vector>

namespace
{
using namespace algebra;
using namespace dealii;
using hpvi::LinearSolver;
using hpvi::NumericalFailure;
using hpvi::SymmetricMatrix;

SymmetricMatrix diagonal(const unsigned int n, const double value)
{
  SymmetricMatrix A;
  A.row.resize(n);
  std::iota(A.row.begin(), A.row.end(), 0);
  A.value.assign(n, value);
  A.column_start.resize(n + 1);
  std::iota(A.column_start.begin(), A.column_start.end(), 0);
  return A;
}

/** The identity, and a last unknown that every other one is coupled to. */
SymmetricMatrix star(const unsigned int n)
{
  SymmetricMatrix A = diagonal(n, 1.);
  for (unsigned int i = 0; i + 1 < n; ++i)
  {
    A.row.push_back(i);
    A.value.push_back(1e-6);
  }
  A.column_start.back() = A.row.size();
  return A;
}

/**
 * All memory that there is, but for @p n_blocks of @p size bytes. A block that is refused may yet be found where malloc keeps what
 * other threads have left, of which it looks at one at a time.
 */
std::vector<std::unique_ptr<char[]>> all_but(const unsigned int n_blocks, const std::size_t size,
                                             std::vector<std::unique_ptr<char[]>> all)
{
  std::vector<std::unique_ptr<char[]>> large;
  large.reserve(1000);
  for (const std::size_t block : {size, size / 64})
    for (unsigned int n_refused = 0; n_refused < 64;)
      if (char *const found = new (std::nothrow) char[block])
        (block == size ? large : all).emplace_back(found);
      else
        ++n_refused;
  for (std::size_t k = n_blocks; k < large.size(); ++k)
    all.push_back(std::move(large[k]));
  return all;
}

/** What a factorisation fails with within so many bytes; @p n_contact unknowns are kept. */
std::string failure_of(const SymmetricMatrix &A, const unsigned int n_contact = 0,
                       const double bytes = 1e15)
{
  std::vector<unsigned int> interface(n_contact);
  std::iota(interface.begin(), interface.end(), 0);
  const AddressSpaceLimit limit(bytes);
  return ::failure_of<NumericalFailure>(
      [&] { LinearSolver(A, interface, n_contact > 0 ? 8. * n_contact * n_contact : 0.); });
}

TEST(LinearSolver, NotPositiveDefinite)
{
  for (const double value : {0., -1.})
  {
    SymmetricMatrix A = diagonal(5, 1.);
    A.value[3] = value;
    EXPECT_TRUE(says(failure_of(A), "not positive definite: a rigid-body motion")) << failure_of(A);
  }
  EXPECT_EQ(failure_of(diagonal(5, 1.)), "");
}

/** Another matrix with entries in the same places: as if it were factored from the beginning, and failing likewise. */
TEST(LinearSolver, FactorsAgain)
{
  const unsigned int n = 30;
  const std::vector<unsigned int> interface = {3, 8, 20};
  const std::vector<hpvi::Stabilisation> stabilisation = {{{{3, 0.6}, {20, 0.8}}, 2.}};
  const auto matrix = [](const double shift)
  {
    SymmetricMatrix A = star(n);
    for (unsigned int k = 0; k < A.value.size(); ++k)
      A.value[k] += shift * (A.row[k] + 1.) / n;
    return A;
  };
  Vector<double> f(n);
  std::iota(f.begin(), f.end(), 1.);
  LinearSolver again(matrix(0.1), interface, 0., stabilisation);
  for (const double shift : {0.2, 0.05})
  {
    const LinearSolver fresh(matrix(shift), interface, 0., stabilisation);
    again.factor_again(matrix(shift), stabilisation);
    Vector<double> difference = again.solve(f);
    difference -= fresh.solve(f);
    EXPECT_LE(difference.linfty_norm(), 1e-12 * f.linfty_norm());
    ASSERT_EQ(again.interface_order(), fresh.interface_order());
    for (unsigned int i = 0; i < interface.size(); ++i)
      for (unsigned int j = 0; j <= i; ++j)
        EXPECT_NEAR(again.kept_factor()(i, j), fresh.kept_factor()(i, j), 1e-12);
  }
  EXPECT_THROW(again.factor_again(matrix(-10.), stabilisation), NumericalFailure);
}

/** The unknown in the middle of the star goes first and leaves a dense matrix of all others. */
TEST(LinearSolver, FactorWithMoreEntriesThanAnIndexCounts)
{
  const unsigned int n = 70000;
  const std::string failure = failure_of(star(n), n - 1);
  EXPECT_TRUE(says(failure, "(70000 unknowns) has more entries than its indices can count"))
      << failure;
}

TEST(LinearSolver, FactorBeyondTheMemory)
{
  if (!AddressSpaceLimit::can_be_tested())
    GTEST_SKIP();
  const unsigned int n = 8000; // 512 MB of L and as much of its dense block
  const std::string failure = failure_of(star(n), n - 1, 256e6);
  EXPECT_TRUE(says(failure, "the factorisation of 8000 unknowns needs 1.")) << failure;
  EXPECT_TRUE(says(failure, "left of the address space (ulimit -v)")) << failure;
}

/** Of so many unknowns METIS finds the order. */
TEST(LinearSolver, DissectsManyUnknowns)
{
  const unsigned int n = 160000;
  SymmetricMatrix A; // of a chain, upper triangle
  A.resize(2 * n - 1);
  for (unsigned int j = 0, entry = 0; j < n; ++j)
  {
    for (const unsigned int i : {j - 1, j})
      if (i < n)
      {
        A.row[entry] = i;
        A.value[entry++] = i == j ? 3. : -1.;
      }
    A.column_start.push_back(entry);
  }
  Vector<double> f(n);
  f = 1.;
  const Vector<double> x = LinearSolver(A, {}).solve(f);
  for (const unsigned int i : {1U, n / 3, n - 2})
    EXPECT_NEAR(3 * x[i] - x[i - 1] - x[i + 1], 1., 1e-14);
}

/** The ordering asks for memory before anyone knows how much the factor will take. */
TEST(LinearSolver, OrderingBeyondTheMemory)
{
  if (!AddressSpaceLimit::can_be_tested())
    GTEST_SKIP();
  // Three permutations fit, what CAMD works on does not.
  const std::string failure = failure_of(diagonal(500000, 1.), 0, 10e6);
  EXPECT_TRUE(says(failure, "the factorisation of 500000 unknowns is out of memory")) << failure;
}

TEST(LinearSolver, SolutionBeyondTheMemory)
{
  if (!AddressSpaceLimit::can_be_tested())
    GTEST_SKIP();
  const unsigned int n = 100000;
  const LinearSolver solver(diagonal(n, 2.), {});
  const Vector<double> f(n);
  // For the first half of a solution alone, and for a part of the second.
  for (const unsigned int n_blocks : {1, 2})
  {
    std::vector<std::unique_ptr<char[]>> blocks;
    blocks.reserve(100000);
    const AddressSpaceLimit limit(6e6);
    const auto the_rest = all_but(n_blocks, n * sizeof(double) + 8192, std::move(blocks));
    EXPECT_THROW(solver.solve(f), std::bad_alloc) << n_blocks;
  }
}
} // namespace
