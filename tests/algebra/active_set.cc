// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs.h"

#include <hpvi/solvers/active_set.h>

namespace
{
using namespace algebra;
using hpvi::ActiveSet;

TEST(ActiveSet, AgreesWithEnumeration)
{
  for (unsigned int n = 1; n <= 6; ++n)
    for (unsigned int seed = 0; seed < 60; ++seed)
    {
      SCOPED_TRACE("n = " + std::to_string(n) + ", seed " + std::to_string(seed));
      std::mt19937 random(1000 * n + seed);
      const QuadraticProgram qp = random_program(n, random);
      Vector<double> z = random_vector(n, random);
      const QpReport report = ActiveSet(with_tolerance(1e-12)).solve(qp, z);
      EXPECT_TRUE(report.converged);
      EXPECT_TRUE(is_feasible(qp, z));
      expect_near(z, minimiser_by_enumeration(qp), 1e-9);
    }
}

TEST(ActiveSet, EndsWhereMprgpEnds)
{
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const QuadraticProgram qp = random_program(80, random);
    Vector<double> z(80), other(80);
    const QpReport report = ActiveSet(with_tolerance(1e-12)).solve(qp, z);
    EXPECT_TRUE(report.converged);
    EXPECT_TRUE(is_feasible(qp, z));
    EXPECT_TRUE(Mprgp(with_tolerance(1e-12)).solve(qp, other).converged);
    expect_near(z, other, 1e-8);
  }
}

TEST(ActiveSet, OneSolveFromTheMinimiser)
{
  for (const double load : {0.2, 0.5, 1., 2.})
  {
    const QuadraticProgram qp = edge_program(load);
    Vector<double> minimiser(qp.d.size());
    EXPECT_TRUE(Mprgp(with_tolerance(1e-13)).solve(qp, minimiser).converged);
    Vector<double> z = minimiser;
    const QpReport report = ActiveSet(with_tolerance(1e-13)).solve(qp, z);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.dense_solves, 1u);
    EXPECT_FALSE(report.fell_back);
    expect_near(z, minimiser, 1e-8); // cond(S) is about 1e4
  }
}

/** `S = v v' + w w' + 0.01 I`, where the method often cycles; the fallback finds the minimiser. */
TEST(ActiveSet, CyclesEndInTheFallback)
{
  unsigned int cycles = 0;
  for (unsigned int seed = 0; seed < 400; ++seed)
  {
    const unsigned int n = 6;
    std::mt19937 random(seed);
    QuadraticProgram qp{LAPACKFullMatrix<double>(n), random_vector(n, random), unit_box(n)};
    const Vector<double> v = random_vector(n, random), w = random_vector(n, random);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        qp.S(i, j) = v[i] * v[j] + w[i] * w[j] + (i == j ? 0.01 : 0.);
    Vector<double> z(n);
    const QpReport report = ActiveSet(with_tolerance(1e-12)).solve(qp, z);
    EXPECT_TRUE(report.converged) << "seed " << seed;
    EXPECT_TRUE(is_feasible(qp, z));
    expect_near(z, minimiser_by_enumeration(qp), 1e-9);
    cycles += report.fell_back;
    EXPECT_EQ(report.fell_back,
              report.cg_steps + report.expansion_steps + report.proportioning_steps > 0);
  }
  EXPECT_GT(cycles, 3u);
}

/** Components whose gradient and wall coincide at the minimiser: either state is right. */
TEST(ActiveSet, DegenerateComponents)
{
  for (unsigned int seed = 0; seed < 50; ++seed)
  {
    const unsigned int n = 40;
    std::mt19937 random(seed);
    QuadraticProgram qp{random_matrix(n, random), Vector<double>(n), unit_box(n)};
    Vector<double> minimiser(n);
    for (unsigned int i = 0; i < n; ++i)
      minimiser[i] = i % 3 == 0 ? 1. : i % 3 == 1 ? -1. : 0.3;
    qp.S.vmult(qp.d, minimiser);
    Vector<double> z(n);
    const QpReport report = ActiveSet(with_tolerance(1e-12)).solve(qp, z);
    EXPECT_TRUE(report.converged) << "seed " << seed;
    EXPECT_TRUE(is_feasible(qp, z));
    expect_near(z, minimiser, 1e-10);
  }
}

/** With a singular S the factorisation fails, and Mprgp goes on. */
TEST(ActiveSet, SingularMatrix)
{
  QuadraticProgram qp{LAPACKFullMatrix<double>(2), vec({0.5, 0.5}), unit_box(2)};
  for (unsigned int i = 0; i < 2; ++i)
    for (unsigned int j = 0; j < 2; ++j)
      qp.S(i, j) = 1.;
  Vector<double> z(2);
  const QpReport report = ActiveSet(with_tolerance(1e-12)).solve(qp, z);
  EXPECT_TRUE(report.converged);
  EXPECT_TRUE(report.fell_back);
  EXPECT_NEAR(z[0] + z[1], 0.5, 1e-12);
}

TEST(ActiveSet, NothingAndNotANumber)
{
  Vector<double> none;
  EXPECT_TRUE(ActiveSet(with_tolerance(1e-12)).solve(QuadraticProgram(), none).converged);
  for (const double bad : {not_a_number, infinity})
  {
    QuadraticProgram qp = edge_program(1.);
    qp.S(3, 3) = bad;
    Vector<double> z(qp.d.size());
    const QpReport report = ActiveSet(with_tolerance(1e-12)).solve(qp, z);
    EXPECT_FALSE(report.converged);
    EXPECT_TRUE(std::isnan(report.projected_gradient));
  }
}
} // namespace
