// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs.h"

namespace
{
using namespace algebra;

void compare_with_enumeration(const unsigned int n, const unsigned int seed, const bool scaling)
{
  SCOPED_TRACE("n = " + std::to_string(n) + ", seed " + std::to_string(seed));
  std::mt19937 random(1000 * n + seed);
  const QuadraticProgram qp = random_program(n, random);
  Vector<double> z = random_vector(n, random);
  Mprgp::Settings settings = with_tolerance(1e-12);
  settings.diagonal_scaling = scaling;
  const QpReport report = Mprgp(settings).solve(qp, z);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.projected_gradient, 1e-12);
  EXPECT_TRUE(is_feasible(qp, z));
  expect_near(z, minimiser_by_enumeration(qp), 1e-9);
}

TEST(Mprgp, AgreesWithEnumerationOfActiveSets)
{
  for (unsigned int n = 1; n <= 6; ++n)
    for (unsigned int seed = 0; seed < 60; ++seed)
      compare_with_enumeration(n, seed, seed % 2 == 0);
  for (unsigned int n = 7; n <= 8; ++n)
    for (unsigned int seed = 0; seed < 10; ++seed)
      compare_with_enumeration(n, seed, seed % 2 == 0);
}

TEST(Mprgp, HoldsForAnyProportioningParameter)
{
  for (const double gamma : {0.01, 100.})
    for (unsigned int seed = 0; seed < 20; ++seed)
    {
      std::mt19937 random(seed);
      const QuadraticProgram qp = random_program(5, random);
      Mprgp::Settings settings = with_tolerance(1e-12);
      settings.gamma = gamma;
      Vector<double> z(5);
      EXPECT_TRUE(Mprgp(settings).solve(qp, z).converged);
      expect_near(z, minimiser_by_enumeration(qp), 1e-9);
    }
}

TEST(Mprgp, ToleranceIsKept)
{
  std::mt19937 random(3);
  QuadraticProgram qp = random_program(100, random);
  Vector<double> start = random_vector(100, random), Sz(100);
  qp.feasible_set.project(start);
  qp.S.vmult(Sz, start);
  const double reference = std::max(qp.d.l2_norm(), Sz.l2_norm());
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12})
  {
    Mprgp::Settings settings = with_tolerance(tolerance);
    settings.diagonal_scaling = false; // so that it is |nu| in the given variables that is small
    Vector<double> z = start;
    const QpReport report = Mprgp(settings).solve(qp, z);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(projected_gradient(qp, z), 1.001 * tolerance * reference);
    EXPECT_NEAR(report.projected_gradient, projected_gradient(qp, z) / reference, 1e-14);
  }
}

TEST(Mprgp, WithoutWallsItIsConjugateGradients)
{
  const unsigned int n = 8;
  std::mt19937 random(5);
  QuadraticProgram qp = random_program(n, random);
  Vector<double> z(n), Sz(n);
  qp.feasible_set = box(n, -infinity, infinity);
  const QpReport report = Mprgp(with_tolerance(1e-10)).solve(qp, z);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.cg_steps, n + 1);
  EXPECT_EQ(report.expansion_steps, 0u);
  EXPECT_EQ(report.proportioning_steps, 0u);
  EXPECT_EQ(report.multiplications, report.cg_steps + 1); // the last one confirms the gradient
  qp.S.vmult(Sz, z);
  expect_near(Sz, qp.d, 1e-9);
}

/** A CG or proportioning step costs one product, an expansion two or three. */
TEST(Mprgp, CountsAddUp)
{
  unsigned int expansions = 0, proportionings = 0;
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    std::mt19937 random(seed);
    const QuadraticProgram qp = random_program(60, random);
    Vector<double> z(60);
    const QpReport report = Mprgp(with_tolerance(1e-9)).solve(qp, z);
    const unsigned int single = report.cg_steps + report.proportioning_steps;
    EXPECT_GE(report.multiplications, single + 2 * report.expansion_steps);
    EXPECT_LE(report.multiplications, single + 3 * report.expansion_steps + 3);
    expansions += report.expansion_steps;
    proportionings += report.proportioning_steps;
  }
  EXPECT_GT(expansions, 20u); // the programs reach every branch
  EXPECT_GT(proportionings, 5u);
}

/**
 * Rows with factors 2^-13 to 2^13: in the scaled variables the run is that for the matrix without
 * them, bit by bit. Without scaling it takes many times the products.
 */
TEST(Mprgp, ScalingUndoesBadScaling)
{
  const unsigned int n = 80;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> exponent(-13, 13);
  QuadraticProgram good{random_matrix(n, random), random_vector(n, random), unit_box(n)};
  QuadraticProgram bad = good;
  Vector<double> factor(n), inverse(n);
  for (unsigned int i = 0; i < n; ++i)
    inverse[i] = 1. / (factor[i] = std::pow(2., exponent(random)));
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      bad.S(i, j) = factor[i] * good.S(i, j) * factor[j];
  bad.d.scale(factor);
  bad.feasible_set = good.feasible_set.scaled(factor);
  ASSERT_GT(hpvi::condition_number(bad.S), 1e8);

  Vector<double> z_good(n), z_bad(n), z_raw(n);
  const QpReport report_good = Mprgp(with_tolerance(1e-9)).solve(good, z_good);
  const QpReport report_bad = Mprgp(with_tolerance(1e-9)).solve(bad, z_bad);
  EXPECT_TRUE(report_bad.converged);
  EXPECT_EQ(report_bad.multiplications, report_good.multiplications);
  z_bad.scale(factor);
  EXPECT_EQ(z_bad, z_good);

  Mprgp::Settings raw = with_tolerance(1e-9);
  raw.diagonal_scaling = false;
  raw.maximum_multiplications = 10 * report_bad.multiplications;
  EXPECT_FALSE(Mprgp(raw).solve(bad, z_raw).converged);
}

TEST(Mprgp, FewProductsOnAContactEdge)
{
  for (const double load : {0.2, 0.5, 1., 2.})
  {
    const QuadraticProgram qp = edge_program(load);
    Vector<double> z(qp.d.size());
    const QpReport report = Mprgp(with_tolerance(1e-9)).solve(qp, z);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.multiplications, 120u) << "load " << load; // measured: 14 to 65
  }
}

/**
 * The iterates are those of a run cut short after k products: the value must never rise. Returns
 * the number of iterates.
 */
unsigned int expect_falling_values(const QuadraticProgram &qp, const Vector<double> &start)
{
  double last = infinity;
  unsigned int iterates = 0;
  Mprgp::Settings settings;
  bool converged = false;
  for (unsigned int limit = 0; !converged && limit < 1000; ++limit)
  {
    settings.maximum_multiplications = limit;
    Vector<double> z = start;
    converged = Mprgp(settings).solve(qp, z).converged;
    const double now = value(qp, z);
    EXPECT_LE(now, last + 1e-13 * std::abs(last)) << "limit " << limit;
    iterates += now != last;
    last = now;
  }
  EXPECT_TRUE(converged);
  return iterates;
}

TEST(Mprgp, ValueFallsMonotonically)
{
  for (unsigned int seed = 0; seed < 4; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const QuadraticProgram qp =
        seed == 0 ? edge_program(0.7) : random_program(30 + 10 * seed, random);
    EXPECT_GT(expect_falling_values(qp, random_vector(qp.d.size(), random)), 10u);
  }
}

/**
 * `S = v v' + 0.01 I`: the projection of a CG step leaves the valley and often raises the value,
 * and a projected gradient step may be no longer than 2/|S|.
 */
TEST(Mprgp, ValueFallsInNarrowValleys)
{
  for (unsigned int seed = 0; seed < 100; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const unsigned int n = 2 + seed % 5;
    std::mt19937 random(seed);
    QuadraticProgram qp{LAPACKFullMatrix<double>(n), random_vector(n, random), unit_box(n)};
    const Vector<double> v = random_vector(n, random);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        qp.S(i, j) = v[i] * v[j] + (i == j ? 0.01 : 0.);
    Vector<double> start = random_vector(n, random);
    start *= 0.5;
    EXPECT_GT(expect_falling_values(qp, start), 1u);
  }
}

TEST(Mprgp, ReportsTheLimit)
{
  const QuadraticProgram qp = edge_program(0.7);
  for (const unsigned int limit : {1u, 7u, 20u})
  {
    Mprgp::Settings settings;
    settings.maximum_multiplications = limit;
    Vector<double> z(qp.d.size());
    const QpReport report = Mprgp(settings).solve(qp, z);
    EXPECT_FALSE(report.converged);
    EXPECT_GT(report.projected_gradient, settings.tolerance);
    EXPECT_GE(report.multiplications, limit);
    EXPECT_LE(report.multiplications, limit + 3);
    EXPECT_TRUE(is_feasible(qp, z));
  }
}

/** Nobody gets a gradient of exactly zero: the run has to notice that it is at rest. */
TEST(Mprgp, ToleranceBelowRoundOffEnds)
{
  for (const double tolerance : {0., 1e-20})
    for (unsigned int seed = 0; seed < 20; ++seed)
    {
      const unsigned int n = 30;
      std::mt19937 random(seed);
      QuadraticProgram qp = seed == 0 ? edge_program(0.7) : random_program(n, random);
      if (seed % 2 == 1) // degenerate: on the walls the sign of the gradient is round-off
      {
        Vector<double> solution = random_vector(n, random);
        qp.feasible_set.project(solution);
        qp.S.vmult(qp.d, solution);
      }
      Vector<double> z(qp.d.size());
      const QpReport report = Mprgp(with_tolerance(tolerance)).solve(qp, z);
      EXPECT_EQ(report.converged, report.projected_gradient <= tolerance);
      EXPECT_LT(report.projected_gradient, 1e-13);
      EXPECT_LT(report.multiplications, 500u);
    }
}

/** Solutions whose gradient vanishes on the walls too: no strict complementarity. */
TEST(Mprgp, DegenerateSolutionOnTheWall)
{
  for (unsigned int seed = 0; seed < 30; ++seed)
  {
    const unsigned int n = 20;
    std::mt19937 random(seed);
    QuadraticProgram qp{random_matrix(n, random), Vector<double>(n), unit_box(n)};
    Vector<double> solution = random_vector(n, random), z(n);
    solution *= 2.; // most components on a wall
    qp.feasible_set.project(solution);
    qp.S.vmult(qp.d, solution);
    const QpReport report = Mprgp(with_tolerance(1e-12)).solve(qp, z);
    EXPECT_TRUE(report.converged);
    expect_near(z, solution, 1e-9);
  }
}

TEST(Mprgp, ComponentsOnAWallAreExactlyOnIt)
{
  unsigned int on_wall = 0;
  for (unsigned int seed = 0; seed < 10; ++seed)
  {
    const unsigned int n = 40;
    std::mt19937 random(seed);
    QuadraticProgram qp{random_matrix(n, random), random_vector(n, random), unit_box(n)};
    Vector<double> z(n), Sz(n);
    EXPECT_TRUE(Mprgp(with_tolerance(1e-10)).solve(qp, z).converged);
    qp.S.vmult(Sz, z);
    for (unsigned int i = 0; i < n; ++i)
      if (std::abs(Sz[i] - qp.d[i]) > 1e-6) // a multiplier of the wall: the component must be there
      {
        EXPECT_EQ(std::abs(z[i]), 1.);
        ++on_wall;
      }
  }
  EXPECT_GT(on_wall, 50u);
}

TEST(Mprgp, NothingToSolve)
{
  const QuadraticProgram qp{LAPACKFullMatrix<double>(0), Vector<double>(), FeasibleSet()};
  Vector<double> z;
  const QpReport report = Mprgp({}).solve(qp, z);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.multiplications, 0u);
}

TEST(Mprgp, ZeroLoad)
{
  std::mt19937 random(11);
  QuadraticProgram qp{random_matrix(6, random), Vector<double>(6), unit_box(6)};
  Vector<double> z(6);
  const QpReport at_once = Mprgp({}).solve(qp, z);
  EXPECT_TRUE(at_once.converged);
  EXPECT_EQ(at_once.multiplications, 0u);
  EXPECT_TRUE(z.all_zero());

  z = random_vector(6, random);
  EXPECT_TRUE(Mprgp(with_tolerance(1e-12)).solve(qp, z).converged);
  expect_near(z, Vector<double>(6), 1e-10);

  // Zero outside the box: the first iterate is its projection.
  qp.feasible_set = box(6, 0.5, infinity);
  z = 0.;
  EXPECT_TRUE(Mprgp(with_tolerance(1e-12)).solve(qp, z).converged);
  expect_near(z, minimiser_by_enumeration(qp), 1e-9);
}

TEST(Mprgp, StartOutsideIsProjectedFirst)
{
  const QuadraticProgram qp = edge_program(0.7);
  std::mt19937 random(13);
  Vector<double> outside = random_vector(qp.d.size(), random);
  outside *= 100.;
  Vector<double> projected = outside;
  qp.feasible_set.project(projected);
  ASSERT_NE(outside, projected);
  const QpReport a = Mprgp({}).solve(qp, outside);
  const QpReport b = Mprgp({}).solve(qp, projected);
  EXPECT_TRUE(a.converged);
  EXPECT_EQ(a.multiplications, b.multiplications);
  EXPECT_EQ(outside, projected);
}

TEST(Mprgp, WarmStartAtTheSolution)
{
  const QuadraticProgram qp = edge_program(0.7);
  Vector<double> z(qp.d.size());
  ASSERT_TRUE(Mprgp(with_tolerance(1e-11)).solve(qp, z).converged);
  const Vector<double> solution = z;
  const QpReport report = Mprgp(with_tolerance(1e-9)).solve(qp, z);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.multiplications, 1u);
  expect_near(z, solution, 1e-15);
}

/** From the lower wall the minimum along the gradient lies beyond the upper one. */
TEST(Mprgp, ProportioningStopsAtTheWall)
{
  QuadraticProgram qp{LAPACKFullMatrix<double>(2), vec({100., 0.25}), unit_box(2)};
  qp.S(0, 0) = qp.S(1, 1) = 1.;
  Vector<double> z = vec({-1., -1.});
  const QpReport report = Mprgp({}).solve(qp, z);
  EXPECT_TRUE(report.converged);
  EXPECT_GE(report.proportioning_steps, 1u);
  EXPECT_EQ(z[0], 1.);
  EXPECT_NEAR(z[1], 0.25, 1e-9);
}

/** A step of the fixed length 1.95/|S| does not move y beside round-off: walls are left by logic. */
TEST(Mprgp, WallsAreLeftBesideALargeStiffness)
{
  QuadraticProgram qp{LAPACKFullMatrix<double>(2), vec({0., 0.5}), unit_box(2)};
  qp.S(0, 0) = 1e20;
  qp.S(1, 1) = 1.;
  Mprgp::Settings settings;
  settings.diagonal_scaling = false;
  Vector<double> z = vec({0., -1.});
  EXPECT_TRUE(Mprgp(settings).solve(qp, z).converged);
  expect_near(z, vec({0., 0.5}), 1e-9);
}

/** S = 0 leaves a linear program, whose solution is a corner. */
TEST(Mprgp, NoCurvature)
{
  QuadraticProgram qp{LAPACKFullMatrix<double>(3), vec({3., -1e-3, 1.}), unit_box(3)};
  Vector<double> z(3);
  EXPECT_TRUE(Mprgp({}).solve(qp, z).converged);
  EXPECT_EQ(z, vec({1., -1., 1.}));
}

/** Where q bends downwards it falls as far as the walls; that is a stationary point, no more. */
TEST(Mprgp, NegativeCurvature)
{
  QuadraticProgram qp{LAPACKFullMatrix<double>(2), vec({1., 2.}), unit_box(2)};
  qp.S(0, 0) = 1.;
  qp.S(1, 1) = -1.;
  Vector<double> z(2);
  EXPECT_TRUE(Mprgp({}).solve(qp, z).converged);
  expect_near(z, vec({1., 1.}), 1e-8);
  expect_falling_values(qp, Vector<double>(2));
}

/** A row without coupling (g = 0 there) must not spoil the others. */
TEST(Mprgp, VanishingRow)
{
  std::mt19937 random(17);
  QuadraticProgram qp{random_matrix(6, random), random_vector(6, random), unit_box(6)};
  for (unsigned int i = 0; i < 6; ++i)
    qp.S(2, i) = qp.S(i, 2) = 0.;
  qp.d[2] = 0.;
  Vector<double> z(6);
  EXPECT_TRUE(Mprgp(with_tolerance(1e-12)).solve(qp, z).converged);
  EXPECT_EQ(z[2], 0.);
  qp.S(2, 2) = 1.; // decoupled still, and enumerable
  expect_near(z, minimiser_by_enumeration(qp), 1e-9);
}

TEST(Mprgp, GivesUpWhereThereIsNoMinimum)
{
  QuadraticProgram qp{LAPACKFullMatrix<double>(2), vec({1., 2.}), FeasibleSet()};
  qp.S(0, 0) = 1.;
  qp.S(1, 1) = -1.;
  qp.feasible_set = FeasibleSet(vec({-1., -1.}), vec({1., infinity}));
  Vector<double> z(2);
  EXPECT_FALSE(Mprgp({}).solve(qp, z).converged);
  EXPECT_TRUE(std::isfinite(z.l2_norm()));
  z = vec({1., -1.}); // the same from the wall
  EXPECT_FALSE(Mprgp({}).solve(qp, z).converged);
  EXPECT_TRUE(std::isfinite(z.l2_norm()));
}

TEST(Mprgp, NaNAndInfinityEndTheRun)
{
  std::mt19937 random(19);
  const QuadraticProgram good{random_matrix(4, random), random_vector(4, random), unit_box(4)};
  for (const double bad_value : {not_a_number, infinity})
    for (const bool scaling : {true, false})
    {
      Mprgp::Settings settings;
      settings.diagonal_scaling = scaling;
      const auto converges = [&settings](const QuadraticProgram &qp, const double start)
      {
        Vector<double> z(4);
        z[2] = start;
        return Mprgp(settings).solve(qp, z).converged;
      };
      EXPECT_TRUE(converges(good, 0.));
      EXPECT_FALSE(converges(good, not_a_number));
      EXPECT_TRUE(converges(good, infinity)); // projected
      QuadraticProgram qp = good;
      qp.d[1] = bad_value;
      EXPECT_FALSE(converges(qp, 0.));
      qp = good;
      qp.S(1, 2) = qp.S(2, 1) = bad_value;
      EXPECT_FALSE(converges(qp, 0.));
      qp.d = 0.; // the start is stationary, but for what S?
      EXPECT_FALSE(converges(qp, 0.));
      qp = good;
      qp.S(3, 3) = bad_value;
      EXPECT_FALSE(converges(qp, 0.));
    }
}
} // namespace
