// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>
#include <hpvi/mprgp.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

namespace
{
using namespace dealii;
using hpvi::FeasibleSet;
using hpvi::Mprgp;
using hpvi::QpReport;
using hpvi::QuadraticProgram;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Vector<double> vec(const std::initializer_list<double> &components)
{
  return Vector<double>(components.begin(), components.end());
}

Mprgp::Settings with_tolerance(const double tolerance)
{
  Mprgp::Settings settings;
  settings.tolerance = tolerance;
  return settings;
}

/** `q(z) = 1/2 z'Sz - d'z` */
double value(const QuadraticProgram &qp, const Vector<double> &z)
{
  Vector<double> Sz(z.size());
  qp.S.vmult(Sz, z);
  return 0.5 * (Sz * z) - qp.d * z;
}

/** `|nu(z)|`, from scratch and in the variables as given. */
double projected_gradient(const QuadraticProgram &qp, const Vector<double> &z)
{
  Vector<double> r(z.size()), phi, beta;
  qp.S.vmult(r, z);
  r -= qp.d;
  qp.feasible_set.split_gradient(z, r, phi, beta);
  return std::hypot(phi.l2_norm(), beta.l2_norm());
}

bool is_feasible(const QuadraticProgram &qp, const Vector<double> &z)
{
  Vector<double> projected = z;
  qp.feasible_set.project(projected);
  return projected == z;
}

/** The same sides for all n components. */
FeasibleSet box(const unsigned int n, const double lower, const double upper)
{
  const std::vector<double> l(n, lower), u(n, upper);
  return FeasibleSet(Vector<double>(l.begin(), l.end()), Vector<double>(u.begin(), u.end()));
}

FeasibleSet unit_box(const unsigned int n)
{
  return box(n, -1., 1.);
}

Vector<double> random_vector(const unsigned int n, std::mt19937 &random)
{
  std::normal_distribution<double> normal;
  Vector<double> x(n);
  for (double &x_i : x)
    x_i = normal(random);
  return x;
}

/** `G G' / n + 0.05 I` with normally distributed G: condition around 100. */
LAPACKFullMatrix<double> random_matrix(const unsigned int n, std::mt19937 &random)
{
  std::normal_distribution<double> normal;
  LAPACKFullMatrix<double> G(n), S(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      G(i, j) = normal(random);
  G.mTmult(S, G);
  S /= n;
  for (unsigned int i = 0; i < n; ++i)
    S(i, i) += 0.05;
  return S;
}

/** Each side is missing in one of four cases, and one component in ten is fixed. */
FeasibleSet random_box(const unsigned int n, std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(0., 1.);
  Vector<double> lower(n), upper(n);
  for (unsigned int i = 0; i < n; ++i)
  {
    const double centre = uniform(random) - 0.5;
    const double radius = uniform(random) < 0.1 ? 0. : uniform(random);
    lower[i] = uniform(random) < 0.25 ? -infinity : centre - radius;
    upper[i] = uniform(random) < 0.25 ? infinity : centre + radius;
  }
  return FeasibleSet(lower, upper);
}

QuadraticProgram random_program(const unsigned int n, std::mt19937 &random)
{
  return {random_matrix(n, random), random_vector(n, random), random_box(n, random)};
}

/** Solve S_FF z_F = d_F - S_FA z_A for the free components by elimination. */
void minimise_on_face(const QuadraticProgram &qp, const std::vector<unsigned int> &free,
                      Vector<double> &z)
{
  const unsigned int m = free.size();
  for (const unsigned int i : free)
    z[i] = 0.;
  Vector<double> Sz(z.size());
  qp.S.vmult(Sz, z);
  std::vector<std::vector<double>> a(m, std::vector<double>(m + 1));
  for (unsigned int i = 0; i < m; ++i)
  {
    for (unsigned int j = 0; j < m; ++j)
      a[i][j] = qp.S(free[i], free[j]);
    a[i][m] = qp.d[free[i]] - Sz[free[i]];
  }
  for (unsigned int k = 0; k < m; ++k) // positive definite: no pivoting
    for (unsigned int i = k + 1; i < m; ++i)
      for (unsigned int j = m + 1; j-- > k;)
        a[i][j] -= a[i][k] / a[k][k] * a[k][j];
  for (unsigned int i = m; i-- > 0;)
  {
    for (unsigned int j = i + 1; j < m; ++j)
      a[i][m] -= a[i][j] * z[free[j]];
    z[free[i]] = a[i][m] / a[i][i];
  }
}

/**
 * The minimiser by brute force: it is the feasible one of least value among the minima on the
 * 3^n faces (each component free, at its lower, at its upper side).
 */
Vector<double> minimiser_by_enumeration(const QuadraticProgram &qp)
{
  const unsigned int n = qp.d.size();
  const Vector<double> &lower = qp.feasible_set.lower(), &upper = qp.feasible_set.upper();
  Vector<double> best;
  double best_value = infinity;
  for (unsigned int face = 0; face < std::pow(3, n); ++face)
  {
    Vector<double> z(n);
    std::vector<unsigned int> free;
    bool exists = true;
    for (unsigned int i = 0, code = face; i < n; ++i, code /= 3)
      if (code % 3 == 0)
        free.push_back(i);
      else
      {
        z[i] = code % 3 == 1 ? lower[i] : upper[i];
        exists = exists && std::isfinite(z[i]);
      }
    if (!exists)
      continue;
    minimise_on_face(qp, free, z);
    for (unsigned int i = 0; i < n; ++i)
      exists = exists && z[i] >= lower[i] - 1e-12 && z[i] <= upper[i] + 1e-12;
    if (exists && value(qp, z) < best_value)
    {
      best = z;
      best_value = value(qp, z);
    }
  }
  return best;
}

void expect_near(const Vector<double> &a, const Vector<double> &b, const double tolerance)
{
  ASSERT_EQ(a.size(), b.size());
  for (unsigned int i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

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

/**
 * The operator of a contact edge behaves like the logarithmic kernel: constants on the cells of a
 * mesh that is graded towards the middle, `S_ij = int_i int_j -ln|x-y|`, from the second
 * antiderivative of the kernel.
 */
QuadraticProgram edge_program(const double load)
{
  std::vector<double> x = {0.};
  for (int level = 0; level < 8; ++level)
    for (int part = 1; part <= 6; ++part)
      x.push_back(0.5 - std::pow(2., -1 - level) * (1. - part / 12.));
  for (unsigned int i = x.size(); i-- > 0;)
    x.push_back(1. - x[i]);
  const auto g = [](const double t)
  { return t == 0. ? 0. : t * t * (0.75 - 0.5 * std::log(std::abs(t))); };

  const unsigned int n = x.size() - 1;
  QuadraticProgram qp{LAPACKFullMatrix<double>(n), Vector<double>(n), unit_box(n)};
  for (unsigned int i = 0; i < n; ++i)
  {
    for (unsigned int j = 0; j < n; ++j)
      qp.S(i, j) =
          g(x[i + 1] - x[j]) - g(x[i] - x[j]) - g(x[i + 1] - x[j + 1]) + g(x[i] - x[j + 1]);
    qp.d[i] = load * (x[i + 1] - x[i]) * std::cos(2. * (x[i] + x[i + 1]));
  }
  return qp;
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
  for (const double bad_value : {nan, infinity})
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
      EXPECT_FALSE(converges(good, nan));
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
