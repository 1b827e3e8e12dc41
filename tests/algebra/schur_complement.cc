// SPDX-License-Identifier: LGPL-2.1-or-later
#include "memory.h"

#include <gtest/gtest.h>
#include <hpvi/numerical_failure.h>
#include <hpvi/schur_complement.h>

#include <malloc.h>

#include <numeric>
#include <string>
#include <vector>

namespace
{
using namespace algebra;
using namespace dealii;
using hpvi::NumericalFailure;
using hpvi::SchurComplement;
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

/** What a factorisation fails with; @p n_contact unknowns come last. */
std::string failure_of(const SymmetricMatrix &A, const unsigned int n_contact = 0)
{
  std::vector<unsigned int> contact(n_contact);
  std::iota(contact.begin(), contact.end(), 0);
  try
  {
    SchurComplement(A, Vector<double>(A.n()), contact, FullMatrix<double>(1, n_contact));
  }
  catch (const NumericalFailure &failure)
  {
    return failure.what();
  }
  return "nothing";
}

bool says(const std::string &line, const std::string &words)
{
  return line.find(words) != std::string::npos;
}

TEST(SchurComplement, NotPositiveDefinite)
{
  for (const double value : {0., -1.})
  {
    SymmetricMatrix A = diagonal(5, 1.);
    A.value[3] = value;
    EXPECT_TRUE(says(failure_of(A), "not positive definite: a rigid-body motion")) << failure_of(A);
  }
  EXPECT_EQ(failure_of(diagonal(5, 1.)), "nothing");
}

/** The unknown in the middle of the star goes first and leaves a dense matrix of all others. */
TEST(SchurComplement, FactorWithMoreEntriesThanAnIndexCounts)
{
  const unsigned int n = 70000;
  const std::string failure = failure_of(star(n), n - 1);
  EXPECT_TRUE(says(failure, "(70000 unknowns) has more entries than its indices can count"))
      << failure;
}

TEST(SchurComplement, FactorBeyondTheMemory)
{
  if (!AddressSpaceLimit::can_be_tested())
    GTEST_SKIP();
  const unsigned int n = 8000; // 512 MB of L and as much of its dense block
  const SymmetricMatrix A = star(n);
  const AddressSpaceLimit limit(256e6);
  const std::string failure = failure_of(A, n - 1);
  EXPECT_TRUE(says(failure, "the factorisation of 8000 unknowns needs 1.")) << failure;
  EXPECT_TRUE(says(failure, "left of the address space (ulimit -v)")) << failure;
}

/** The ordering asks for memory before anyone knows how much the factor will take. */
TEST(SchurComplement, OrderingBeyondTheMemory)
{
  if (!AddressSpaceLimit::can_be_tested())
    GTEST_SKIP();
  mallopt(M_MMAP_THRESHOLD, 1 << 20); // what is freed goes back, and does not serve once more
  const SymmetricMatrix A = diagonal(500000, 1.);
  const AddressSpaceLimit limit(14e6); // three permutations fit, what CAMD works on does not
  const std::string failure = failure_of(A);
  EXPECT_TRUE(says(failure, "the factorisation of 500000 unknowns is out of memory")) << failure;
}

TEST(SchurComplement, SolutionBeyondTheMemory)
{
  if (!AddressSpaceLimit::can_be_tested())
    GTEST_SKIP();
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  const unsigned int n = 500000;
  const SchurComplement schur_complement(diagonal(n, 2.), Vector<double>(n), {},
                                         FullMatrix<double>());
  const AddressSpaceLimit limit(10e6); // two vectors fit, a third one does not
  EXPECT_THROW(schur_complement.displacement(Vector<double>()), NumericalFailure);
}
} // namespace
