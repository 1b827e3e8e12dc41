// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs.h"

#include <hpvi/solvers/active_set.h>

#include <functional>

/** Sets of half lines, those of pressures: unbounded, with one wall each. */
namespace
{
using namespace algebra;
using hpvi::ActiveSet;

using Solve = std::function<QpReport(const QuadraticProgram &, Vector<double> &)>;

Solve active_set(const double tolerance)
{
  return [=](const QuadraticProgram &qp, Vector<double> &z)
  { return ActiveSet(with_tolerance(tolerance)).solve(qp, z); };
}

Solve mprgp(const double tolerance)
{
  return [=](const QuadraticProgram &qp, Vector<double> &z)
  { return Mprgp(with_tolerance(tolerance)).solve(qp, z); };
}

/** `z >= 0`, or every third component `z <= 0` */
FeasibleSet half_lines(const unsigned int n, const bool both_ways = false)
{
  FeasibleSet set;
  for (unsigned int i = 0; i < n; ++i)
    if (both_ways && i % 3 == 2)
      set.add_interval(-infinity, 0.);
    else
      set.add_interval(0., infinity);
  return set;
}

/** `D H C H D`: eigenvalues from 1 to 1/condition between reflections, rows of different units. */
LAPACKFullMatrix<double> ill_conditioned(const unsigned int n, const double condition,
                                         std::mt19937 &random)
{
  Vector<double> v = random_vector(n, random), w = random_vector(n, random);
  v /= v.l2_norm();
  w /= w.l2_norm();
  FullMatrix<double> Q(n, n), product(n, n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
    {
      double sum = 0; // of the product of two reflections
      for (unsigned int k = 0; k < n; ++k)
        sum += ((i == k) - 2. * v[i] * v[k]) * ((k == j) - 2. * w[k] * w[j]);
      Q(i, j) = sum;
    }
  LAPACKFullMatrix<double> S(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j <= i; ++j)
    {
      double sum = 0;
      for (unsigned int k = 0; k < n; ++k)
        sum += Q(i, k) * std::pow(condition, -double(k) / (n - 1)) * Q(j, k);
      S(i, j) = S(j, i) = sum * std::pow(10., (i % 5 + j % 5) / 4.);
    }
  return S;
}

/** `S z - d = r` for a z and r that meet the conditions: the minimiser is z. */
QuadraticProgram with_minimiser(LAPACKFullMatrix<double> S, const Vector<double> &z,
                                const Vector<double> &r, FeasibleSet set)
{
  Vector<double> d(z.size());
  S.vmult(d, z);
  d -= r;
  return {std::move(S), d, std::move(set)};
}

/** Conditions written out: z in its half line, r = 0 inside and pointing out of it on the wall. */
void expect_conditions(const QuadraticProgram &qp, const Vector<double> &z, const double tolerance)
{
  ASSERT_TRUE(is_feasible(qp, z));
  Vector<double> r(z.size());
  qp.S.vmult(r, z);
  double size = std::max(r.linfty_norm(), qp.d.linfty_norm());
  r -= qp.d;
  Vector<double> far(z.size());
  far = infinity;
  qp.feasible_set.project(far);
  for (unsigned int i = 0; i < z.size(); ++i)
  {
    const double sign = far[i] > 0. ? 1. : -1.; // of the open end
    EXPECT_GE(sign * r[i], -tolerance * size) << "component " << i;
    if (z[i] != 0.)
    {
      EXPECT_LE(std::abs(r[i]), tolerance * size) << "component " << i;
    }
  }
}

TEST(HalfLines, RandomPrograms)
{
  for (const Solve &solve : {active_set(1e-12), mprgp(1e-12)})
    for (unsigned int seed = 0; seed < 40; ++seed)
    {
      SCOPED_TRACE("seed " + std::to_string(seed));
      std::mt19937 random(seed);
      const unsigned int n = seed < 20 ? 7 : 60;
      const QuadraticProgram qp{random_matrix(n, random), random_vector(n, random),
                                half_lines(n, seed % 2 == 1)};
      Vector<double> z = random_vector(n, random);
      EXPECT_TRUE(solve(qp, z).converged);
      expect_conditions(qp, z, 1e-10);
      if (n == 7)
        expect_near(z, minimiser_by_enumeration(qp), 1e-9);
    }
}

TEST(HalfLines, IllConditioned)
{
  for (const double condition : {1e2, 1e6, 1e10})
    for (unsigned int seed = 0; seed < 10; ++seed)
    {
      SCOPED_TRACE("condition " + std::to_string(condition) + ", seed " + std::to_string(seed));
      std::mt19937 random(seed);
      const unsigned int n = 40;
      Vector<double> z(n), r(n), parts = random_vector(n, random);
      for (unsigned int i = 0; i < n; ++i)
        (parts[i] > 0. ? z : r)[i] = std::abs(parts[i]);
      const QuadraticProgram qp =
          with_minimiser(ill_conditioned(n, condition, random), z, r, half_lines(n));
      Vector<double> x(n);
      EXPECT_TRUE(active_set(1e-10)(qp, x).converged);
      expect_conditions(qp, x, 1e-8);
      x = 0.;
      const QpReport report = mprgp(1e-8)(qp, x);
      EXPECT_TRUE(report.converged) << report.projected_gradient;
      expect_conditions(qp, x, 1e-6);
    }
}

/** Points that touch without pressure: z = 0 and r = 0. Either state is right. */
TEST(HalfLines, Grazing)
{
  for (const Solve &solve : {active_set(1e-12), mprgp(1e-12)})
    for (unsigned int seed = 0; seed < 30; ++seed)
    {
      SCOPED_TRACE("seed " + std::to_string(seed));
      std::mt19937 random(seed);
      const unsigned int n = 45;
      Vector<double> z(n), r(n);
      for (unsigned int i = 0; i < n; ++i)
        if (i % 3 == 0)
          z[i] = 1.;
        else if (i % 3 == 1)
          r[i] = 1.;
      const QuadraticProgram qp = with_minimiser(random_matrix(n, random), z, r, half_lines(n));
      Vector<double> x = random_vector(n, random);
      EXPECT_TRUE(solve(qp, x).converged);
      expect_conditions(qp, x, 1e-10);
      expect_near(x, z, 1e-9);
    }
}

/** All closed, nothing touches, and nothing touches anywhere near. */
TEST(HalfLines, AllClosedAndAllOpen)
{
  const unsigned int n = 30;
  for (const Solve &solve : {active_set(1e-12), mprgp(1e-12)})
    for (unsigned int seed = 0; seed < 10; ++seed)
    {
      SCOPED_TRACE("seed " + std::to_string(seed));
      std::mt19937 random(seed);
      Vector<double> positive = random_vector(n, random);
      for (double &x : positive)
        x = 0.01 + std::abs(x);
      const Vector<double> none(n);
      const QuadraticProgram closed =
          with_minimiser(random_matrix(n, random), positive, none, half_lines(n));
      Vector<double> z(n);
      EXPECT_TRUE(solve(closed, z).converged);
      expect_near(z, positive, 1e-9);
      for (const double distance : {1., 1e-12, 0.})
      {
        Vector<double> r(positive);
        r *= distance;
        const QuadraticProgram open =
            with_minimiser(random_matrix(n, random), none, r, half_lines(n));
        z = positive; // all closed at the start
        EXPECT_TRUE(solve(open, z).converged) << distance;
        // The tolerance is one beside the start: what is left is no pressure to speak of.
        EXPECT_LE(z.linfty_norm(), distance == 1. ? 0. : 1e-9);
      }
    }
}
} // namespace
