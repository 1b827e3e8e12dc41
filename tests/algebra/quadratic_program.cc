// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>
#include <hpvi/solvers/quadratic_program.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>

namespace
{
using namespace dealii;
using hpvi::FeasibleSet;
using hpvi::infinity;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Vector<double> vec(const std::initializer_list<double> &components)
{
  return Vector<double>(components.begin(), components.end());
}

/** [-1,1] x [0,inf) x (-inf,2] x R x {3} */
FeasibleSet mixed_box()
{
  return FeasibleSet(vec({-1., 0., -infinity, -infinity, 3.}),
                     vec({1., infinity, 2., infinity, 3.}));
}

TEST(FeasibleSet, EmptyByDefault)
{
  EXPECT_EQ(FeasibleSet().size(), 0u);
  Vector<double> nothing;
  EXPECT_EQ(FeasibleSet().distance_to_wall(nothing, nothing), infinity);
}

TEST(FeasibleSet, RefusesSidesThatCross)
{
  const auto box = [](const double l, const double u) { return FeasibleSet(vec({l}), vec({u})); };
  EXPECT_ANY_THROW(box(1., 0.));
  EXPECT_ANY_THROW(box(nan, 0.));
  EXPECT_ANY_THROW(box(0., nan));
  EXPECT_ANY_THROW(box(infinity, infinity));
  EXPECT_ANY_THROW(box(-infinity, -infinity));
  EXPECT_ANY_THROW(FeasibleSet(Vector<double>(2), Vector<double>(3)));
  EXPECT_NO_THROW(box(1., 1.));
}

TEST(FeasibleSet, ProjectsComponentwise)
{
  Vector<double> z = vec({-5., -5., -5., -5., -5.});
  mixed_box().project(z);
  EXPECT_EQ(z, vec({-1., 0., -5., -5., 3.}));
  z = 5.;
  mixed_box().project(z);
  EXPECT_EQ(z, vec({1., 5., 2., 5., 3.}));
  const Vector<double> inside = vec({0.5, 7., -7., 7., 3.});
  z = inside;
  mixed_box().project(z);
  EXPECT_EQ(z, inside);
}

TEST(FeasibleSet, ProjectionKeepsNaN)
{
  Vector<double> z = vec({nan, 0., 0., 0., 3.});
  mixed_box().project(z);
  EXPECT_TRUE(std::isnan(z[0]));
}

TEST(FeasibleSet, DistanceIsTheFirstWall)
{
  const Vector<double> z = vec({0., 1., 1., 0., 3.});
  const auto distance = [&z](const Vector<double> &p)
  { return mixed_box().distance_to_wall(z, p); };
  // The step is -p: positive p runs towards the lower side.
  EXPECT_EQ(distance(vec({2., 0., 0., 0., 0.})), 0.5);
  EXPECT_EQ(distance(vec({-4., 0., 0., 0., 0.})), 0.25);
  EXPECT_EQ(distance(vec({0., 2., 0., 0., 0.})), 0.5);
  EXPECT_EQ(distance(vec({0., -2., 0., 0., 0.})), infinity);
  EXPECT_EQ(distance(vec({0., 0., 1., 0., 0.})), infinity);
  EXPECT_EQ(distance(vec({0., 0., -2., 0., 0.})), 0.5);
  EXPECT_EQ(distance(vec({0., 0., 0., 9., 0.})), infinity);
  EXPECT_EQ(distance(vec({0., 0., 0., 0., 1.})), 0.);
  EXPECT_EQ(distance(vec({2., 4., -8., 1., 0.})), 0.125);
  EXPECT_EQ(distance(Vector<double>(5)), infinity);
}

TEST(FeasibleSet, DistanceOfPointOnWall)
{
  const FeasibleSet box(vec({-1.}), vec({1.}));
  EXPECT_EQ(box.distance_to_wall(vec({1.}), vec({-1.})), 0.);
  EXPECT_EQ(box.distance_to_wall(vec({1.}), vec({1.})), 2.);
}

TEST(FeasibleSet, SplitsTheGradient)
{
  const FeasibleSet box(vec({-1., -1., -1., -1., -1., -infinity}),
                        vec({1., 1., 1., 1., 1., infinity}));
  // Inside; at the lower wall pulled in, pushed out; at the upper wall pulled in, pushed out; no
  // wall.
  const Vector<double> z = vec({0.5, -1., -1., 1., 1., 1e300});
  const Vector<double> r = vec({7., -2., 3., 4., -5., -6.});
  Vector<double> phi, beta;
  box.split_gradient(z, r, phi, beta);
  EXPECT_EQ(phi, vec({7., 0., 0., 0., 0., -6.}));
  EXPECT_EQ(beta, vec({0., -2., 0., 4., 0., 0.}));
}

TEST(FeasibleSet, FixedComponentHasNoProjectedGradient)
{
  const FeasibleSet box(vec({3., 3.}), vec({3., 3.}));
  Vector<double> phi, beta;
  box.split_gradient(vec({3., 3.}), vec({1., -1.}), phi, beta);
  EXPECT_TRUE(phi.all_zero());
  EXPECT_TRUE(beta.all_zero());
}

TEST(FeasibleSet, SplitShowsNaN)
{
  const FeasibleSet box(vec({-1., -1.}), vec({1., 1.}));
  Vector<double> phi, beta;
  for (const double place : {-1., 0., 1., nan})
  {
    box.split_gradient(vec({place, 0.}), vec({nan, 0.}), phi, beta);
    EXPECT_TRUE(std::isnan(phi[0]) || std::isnan(beta[0])) << place;
  }
}

/** The projected gradient is what is left of a short projected step: nu = (z - P(z - a r)) / a. */
TEST(FeasibleSet, SplitIsTheDerivativeOfTheProjection)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  std::uniform_int_distribution<int> place(0, 2);
  for (unsigned int sample = 0; sample < 100; ++sample)
  {
    const unsigned int n = 7;
    Vector<double> lower(n), upper(n), z(n), r(n), phi, beta;
    for (unsigned int i = 0; i < n; ++i)
    {
      lower[i] = uniform(random) - 2.;
      upper[i] = uniform(random) + 2.;
      const double places[] = {lower[i], 0., upper[i]};
      z[i] = places[place(random)];
      r[i] = uniform(random);
    }
    const FeasibleSet box(lower, upper);
    box.split_gradient(z, r, phi, beta);
    const double a = std::pow(2., -10);
    Vector<double> moved = z;
    moved.add(-a, r);
    box.project(moved);
    for (unsigned int i = 0; i < n; ++i)
    {
      EXPECT_NEAR(phi[i] + beta[i], (z[i] - moved[i]) / a, 1e-11);
      EXPECT_EQ(phi[i] * beta[i], 0.);
    }
  }
}

TEST(FeasibleSet, ScalingDividesTheSides)
{
  const FeasibleSet box = mixed_box().scaled(vec({2., 4., 0.5, 3., 0.1}));
  Vector<double> lower = vec({-infinity, -infinity, -infinity, -infinity, -infinity}), upper(lower);
  upper *= -1.;
  box.project(lower);
  box.project(upper);
  EXPECT_EQ(lower, vec({-0.5, 0., -infinity, -infinity, 3. / 0.1}));
  EXPECT_EQ(upper, vec({0.5, infinity, 4., infinity, 3. / 0.1}));
}

/** A symmetric matrix with the given eigenvalues: the diagonal, reflected by I - 2 v v'/v'v. */
LAPACKFullMatrix<double> matrix_with_eigenvalues(const Vector<double> &eigenvalues)
{
  const unsigned int n = eigenvalues.size();
  Vector<double> v(n);
  for (unsigned int i = 0; i < n; ++i)
    v[i] = 1. + i;
  const auto reflection = [&](const unsigned int i, const unsigned int j)
  { return (i == j ? 1. : 0.) - 2. * v[i] * v[j] / v.norm_sqr(); };
  LAPACKFullMatrix<double> S(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < n; ++k)
        S(i, j) += reflection(i, k) * eigenvalues[k] * reflection(k, j);
  return S;
}

TEST(ConditionNumber, RatioOfEigenvalues)
{
  EXPECT_NEAR(hpvi::condition_number(matrix_with_eigenvalues(vec({3., 0.5, 200., 7.}))), 400.,
              1e-9);
  EXPECT_NEAR(hpvi::condition_number(matrix_with_eigenvalues(vec({1e-3, 1., 1e3}))) / 1e6, 1.,
              1e-7);
}

/** Known in closed form for the tridiagonal (-1,2,-1): tan^-2(pi / (2n + 2)). */
TEST(ConditionNumber, SecondDifferences)
{
  const unsigned int n = 70;
  LAPACKFullMatrix<double> S(n);
  for (unsigned int i = 0; i < n; ++i)
  {
    S(i, i) = 2.;
    if (i > 0)
      S(i, i - 1) = S(i - 1, i) = -1.;
  }
  const double tangent = std::tan(M_PI / (2. * n + 2.));
  EXPECT_NEAR(hpvi::condition_number(S) * tangent * tangent, 1., 1e-9);
}

TEST(ConditionNumber, LeavesItsArgumentAlone)
{
  const LAPACKFullMatrix<double> S = matrix_with_eigenvalues(vec({3., 0.5, 200., 7.}));
  const LAPACKFullMatrix<double> copy = S;
  hpvi::condition_number(S);
  EXPECT_EQ(S, copy);
}

TEST(ConditionNumber, NotPositiveDefinite)
{
  EXPECT_EQ(hpvi::condition_number(matrix_with_eigenvalues(vec({1., -1e-3, 2.}))), infinity);
  EXPECT_EQ(hpvi::condition_number(LAPACKFullMatrix<double>(3)), infinity);
  EXPECT_EQ(hpvi::condition_number(LAPACKFullMatrix<double>(0)), 1.);
  LAPACKFullMatrix<double> S = matrix_with_eigenvalues(vec({1., 2.}));
  S(0, 0) = S(0, 1) = S(1, 0) = nan;
  EXPECT_TRUE(std::isnan(hpvi::condition_number(S)));
}

TEST(ScaledByDiagonal, RemovesFactorsOfTheRows)
{
  const LAPACKFullMatrix<double> T = matrix_with_eigenvalues(vec({3., 0.5, 2., 7.}));
  const Vector<double> factor = vec({1., 1e-5, 1e3, 1e-9});
  LAPACKFullMatrix<double> S(4);
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int j = 0; j < 4; ++j)
      S(i, j) = factor[i] * T(i, j) * factor[j];
  const LAPACKFullMatrix<double> scaled = hpvi::scaled_by_diagonal(S);
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int j = 0; j < 4; ++j)
      EXPECT_NEAR(scaled(i, j), T(i, j) / std::sqrt(T(i, i) * T(j, j)), 1e-14);
}

TEST(ScaledByDiagonal, VanishingRowsKeepTheFactorOne)
{
  LAPACKFullMatrix<double> S(4);
  S(0, 0) = 4.;
  S(2, 2) = 1e-40; // round-off of a factor g beside 4, not a row of its own
  S(0, 2) = S(2, 0) = 1e-20;
  S(3, 3) = -1e-17;
  const Vector<double> scale = hpvi::diagonal_scale(S);
  EXPECT_EQ(scale, vec({0.5, 1., 1., 1.}));
  const LAPACKFullMatrix<double> scaled = hpvi::scaled_by_diagonal(S);
  EXPECT_EQ(scaled(0, 0), 1.);
  EXPECT_EQ(scaled(1, 1), 0.);
  EXPECT_EQ(scaled(0, 2), 0.5e-20);
  EXPECT_EQ(scaled(3, 3), -1e-17);
}

TEST(ScaledByDiagonal, AllZero)
{
  const Vector<double> scale = hpvi::diagonal_scale(LAPACKFullMatrix<double>(2));
  EXPECT_EQ(scale, vec({1., 1.}));
  EXPECT_EQ(hpvi::scaled_by_diagonal(LAPACKFullMatrix<double>(0)).m(), 0u);
}
} // namespace
