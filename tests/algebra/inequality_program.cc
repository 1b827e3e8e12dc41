// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs.h"

#include <hpvi/base/numerical_failure.h>
#include <hpvi/solvers/inequality_program.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{
using namespace algebra;
using hpvi::InequalityProgram;

/** A program and its rows, kept for the questions that are asked of its solution. */
struct Program
{
  FullMatrix<double> H;
  Vector<double> h;
  std::vector<std::pair<Vector<double>, double>> equalities, inequalities;

  Program(const unsigned int n, std::mt19937 &random) : H(n, n), h(random_vector(n, random))
  {
    const LAPACKFullMatrix<double> S = random_matrix(n, random);
    H = S;
  }

  InequalityProgram start() const
  {
    InequalityProgram program(H, h);
    for (const auto &[row, value] : equalities)
      EXPECT_TRUE(program.add_equality(row, value));
    for (const auto &[row, least] : inequalities)
      program.add_inequality(row, least);
    return program;
  }
};

/** All rows hold, Hx - h is the sum of rows times multipliers, which have the right sign and place. */
void expect_optimal(const Program &program, const InequalityProgram &solved, const double tolerance)
{
  const Vector<double> &x = solved.minimiser();
  const std::vector<double> y = solved.multipliers();
  Vector<double> rest(x.size());
  program.H.vmult(rest, x);
  rest -= program.h;
  unsigned int i = 0;
  for (const auto &[row, value] : program.equalities)
  {
    EXPECT_NEAR(row * x, value, tolerance);
    rest.add(-y[i++], row);
  }
  for (const auto &[row, least] : program.inequalities)
  {
    EXPECT_GE(row * x, least - tolerance);
    EXPECT_GE(y[i], 0.);
    EXPECT_LE(y[i] * std::abs(row * x - least), tolerance * (1. + y[i])) << "row " << i;
    rest.add(-y[i++], row);
  }
  EXPECT_LE(rest.linfty_norm(), 10. * tolerance);
}

/** Rows that a random point meets, some of them exactly; with equalities among them. */
Program random_rows(const unsigned int n, const unsigned int n_equalities,
                    const unsigned int n_inequalities, std::mt19937 &random)
{
  Program program(n, random);
  const Vector<double> inside = random_vector(n, random);
  std::uniform_real_distribution<double> uniform(0., 1.);
  for (unsigned int i = 0; i < n_equalities + n_inequalities; ++i)
  {
    const Vector<double> row = random_vector(n, random);
    if (i < n_equalities)
      program.equalities.emplace_back(row, row * inside);
    else
      program.inequalities.emplace_back(row,
                                        row * inside - (i % 4 == 0 ? 0. : 0.3 * uniform(random)));
  }
  return program;
}

TEST(InequalityProgram, MeetsTheConditionsOfOptimality)
{
  unsigned int n_active = 0;
  for (unsigned int seed = 0; seed < 200; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const unsigned int n = 1 + seed % 25;
    const Program program = random_rows(n, seed % (n / 3 + 1), 3 * n, random);
    InequalityProgram solved = program.start();
    ASSERT_TRUE(solved.solve());
    expect_optimal(program, solved, 1e-10);
    const std::vector<double> y = solved.multipliers();
    n_active += std::count_if(y.begin(), y.end(), [](const double y_i) { return y_i != 0.; });
  }
  EXPECT_GT(n_active, 1000u); // else the rows were none
}

/** Each row three times, sums of rows as further rows, equalities that others imply. */
TEST(InequalityProgram, BearsRowsThatDependOnOneAnother)
{
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const unsigned int n = 2 + seed % 12;
    Program program = random_rows(n, n / 2, 2 * n, random);
    for (auto *rows : {&program.equalities, &program.inequalities})
    {
      const auto original = *rows;
      for (unsigned int i = 0; i < original.size(); ++i)
      {
        auto [sum, bound] = original[i];
        rows->emplace_back(sum, bound);
        sum += original[(i + 1) % original.size()].first;
        rows->emplace_back(sum, bound + original[(i + 1) % original.size()].second);
      }
    }
    InequalityProgram solved = program.start();
    ASSERT_TRUE(solved.solve());
    expect_optimal(program, solved, 1e-9);
  }
}

/** A vertex where far more faces meet than there are dimensions. */
TEST(InequalityProgram, EndsAtADegenerateVertex)
{
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const unsigned int n = 3 + seed % 6;
    Program program(n, random);
    for (unsigned int i = 0; i < 8 * n; ++i)
    {
      Vector<double> row = random_vector(n, random);
      row *= row * program.h > 0. ? -1. : 1.; // all push against h, towards the origin
      program.inequalities.emplace_back(row, 0.);
    }
    InequalityProgram solved = program.start();
    ASSERT_TRUE(solved.solve());
    expect_optimal(program, solved, 1e-10);
  }
}

TEST(InequalityProgram, FindsThatNothingMeetsTheRows)
{
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const unsigned int n = 1 + seed % 10;
    Program program = random_rows(n, n / 4, 3 * n, random);
    // By Farkas: the sum of some rows, turned around and asked for a little more than they allow.
    Vector<double> sum(n);
    double bound = 0.;
    for (unsigned int i = 0; i < std::min(n, 4u); ++i)
    {
      sum += program.inequalities[i].first;
      bound += program.inequalities[i].second;
    }
    sum *= -1.;
    program.inequalities.emplace_back(sum, -bound + 1e-3);
    EXPECT_FALSE(program.start().solve());
    program.inequalities.pop_back();
    InequalityProgram possible = program.start();
    ASSERT_TRUE(possible.solve());
    possible.add_inequality(sum, sum * possible.minimiser() - 1e-3);
    EXPECT_TRUE(possible.solve());
  }
  std::mt19937 random(1);
  InequalityProgram contradiction(Program(3, random).H, Vector<double>(3));
  EXPECT_TRUE(contradiction.add_equality(vec({1, 2, 0}), 1.));
  EXPECT_TRUE(contradiction.add_equality(vec({2, 4, 0}), 2.));
  EXPECT_FALSE(contradiction.add_equality(vec({1, 2, 0}), 1.001));
}

/** An equality that the start meets by chance binds what comes later. */
TEST(InequalityProgram, KeepsAnEqualityThatHeldFromTheStart)
{
  FullMatrix<double> H(2, 2);
  H(0, 0) = H(1, 1) = 1.;
  InequalityProgram program(H, Vector<double>(2));
  EXPECT_TRUE(program.add_equality(vec({1., -1.}), 0.));
  program.add_inequality(vec({1., 0.}), 1.);
  ASSERT_TRUE(program.solve());
  expect_near(program.minimiser(), vec({1., 1.}), 1e-15);
}

/** Rows in two portions end where all at once do. */
TEST(InequalityProgram, GoesOnWithMoreRows)
{
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const unsigned int n = 2 + seed % 15;
    const Program program = random_rows(n, 1, 4 * n, random);
    InequalityProgram at_once = program.start();
    ASSERT_TRUE(at_once.solve());
    Program first = program;
    first.inequalities.resize(n);
    InequalityProgram later = first.start();
    ASSERT_TRUE(later.solve());
    for (unsigned int i = n; i < 4 * n; ++i)
      later.add_inequality(program.inequalities[i].first, program.inequalities[i].second);
    ASSERT_TRUE(later.solve());
    expect_near(later.minimiser(), at_once.minimiser(), 1e-9);
  }
}

/** Neither the unit of x nor that of H changes the minimiser. */
TEST(InequalityProgram, KnowsNoUnits)
{
  for (const double unit : {1e-9, 1e9})
  {
    std::mt19937 random(5);
    const Program program = random_rows(12, 2, 40, random);
    Program scaled = program;
    scaled.H *= 1e6;
    scaled.h *= 1e6 * unit;
    for (auto *rows : {&scaled.equalities, &scaled.inequalities})
      for (auto &row : *rows)
        row.second *= unit;
    InequalityProgram one = program.start(), other = scaled.start();
    ASSERT_TRUE(one.solve());
    ASSERT_TRUE(other.solve());
    Vector<double> x = other.minimiser();
    x /= unit;
    expect_near(x, one.minimiser(), 1e-10);
  }
}

/** x_0 >= 1 and x_0 <= 1 - miss: a contradiction, or round-off of what both bounds come from. */
TEST(InequalityProgram, ContradictsByRoundOff)
{
  FullMatrix<double> H(2, 2);
  H(0, 0) = H(1, 1) = 1.;
  Vector<double> h(2), row(2), opposite(2), other(2);
  row[0] = other[1] = 1.;
  opposite[0] = -1.;
  for (const double miss : {1e-9, 1e-3})
  {
    InequalityProgram program(H, h);
    program.add_inequality(row, 1.);
    program.add_inequality(opposite, -1. + miss);
    program.add_inequality(other, 0.5);
    EXPECT_FALSE(program.solve());
    EXPECT_EQ(program.solve(1e-8), miss < 1e-8);
    if (miss < 1e-8)
    {
      EXPECT_NEAR(program.minimiser()[0], 1., 1e-8);
      EXPECT_NEAR(program.minimiser()[1], 0.5, 1e-15);
    }
  }
}

/** Bounds at points of a segment, as those of friction: where equations hold x at one of them, that bound says the same again. */
TEST(InequalityProgram, BearsBoundsThatRepeatEquations)
{
  for (unsigned int seed = 0; seed < 300; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const unsigned int n = 4 + seed % 5;
    Program program(n, random);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        program.H(i, j) *= std::pow(10., -0.5 * (i + j)); // what weighs little moves far
    program.h *= 10.;
    const auto at = [&](const double s)
    {
      Vector<double> row(n);
      for (unsigned int i = 0; i < n; ++i)
        row[i] = std::cos(i * std::acos(2. * s - 1.));
      return row;
    };
    const Vector<double> mean = random_vector(n, random);
    program.equalities.emplace_back(mean, 0.3 * mean[0] + 0.7 * mean[1]);
    program.equalities.emplace_back(at(1.), 1.);
    for (unsigned int k = 0; k <= 2 * n; ++k)
      for (const double sign : {1., -1.})
      {
        Vector<double> row = at(0.5 / n * k);
        row *= sign;
        program.inequalities.emplace_back(row, -1.);
      }
    InequalityProgram solved = program.start();
    ASSERT_TRUE(solved.solve());
    const Vector<double> &x = solved.minimiser();
    for (const auto &[row, value] : program.equalities)
      EXPECT_NEAR(row * x, value, 1e-14);
    for (const auto &[row, least] : program.inequalities)
      EXPECT_GE(row * x, least - 1e-13);
    // Without the bound that an equation repeats the minimum is the same, and more than that contradicts it.
    Program once = program;
    once.inequalities.resize(once.inequalities.size() - 2);
    InequalityProgram other = once.start();
    ASSERT_TRUE(other.solve());
    expect_near(x, other.minimiser(), 1e-9);
    once.inequalities.emplace_back(at(1.), 1. + 1e-9);
    EXPECT_FALSE(once.start().solve());
  }
}

TEST(InequalityProgram, RefusesWhatIsNotConvex)
{
  FullMatrix<double> H(2, 2);
  H(0, 0) = 1.;
  H(1, 1) = -1.;
  EXPECT_THROW(InequalityProgram(H, Vector<double>(2)), hpvi::NumericalFailure);
}
} // namespace
