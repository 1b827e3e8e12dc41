// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cones.h"

#include <algorithm>
#include <map>
#include <string>

namespace
{
using namespace algebra;

struct Count
{
  unsigned int open = 0, stick = 0, slip = 0;
};

Count count(const ConeProgram &cones, const Vector<double> &z)
{
  Count result;
  for (const auto &[t, normal, friction] : cones.set.cones)
    ++(z[normal] <= 0.                               ? result.open
       : std::abs(z[t]) == friction.limit(z[normal]) ? result.slip
                                                     : result.stick);
  return result;
}

TEST(CoulombSolver, SolvesRandomProblems)
{
  Vector<double> z, alpha;
  for (const bool bilateral : {false, true})
    for (const double mu : {0.05, 0.3, 1., 2., 5.})
    {
      Count all;
      unsigned int fell_back = 0;
      for (unsigned int seed = 0; seed < 30; ++seed)
      {
        SCOPED_TRACE("mu = " + std::to_string(mu) + ", seed " + std::to_string(seed));
        const ConeProgram cones = random_cones(seed, mu, bilateral);
        const CoulombReport report = solve(cones, z, alpha);
        EXPECT_TRUE(report.qp.converged) << report.residual;
        expect_solution(cones, z, alpha);
        const Count here = count(cones, z);
        all.open += here.open;
        all.stick += here.stick;
        all.slip += here.slip;
        fell_back += report.qp.fell_back;
        // From the solution it is found again at once.
        const Vector<double> solution(z);
        EXPECT_LE(solve(cones, z, alpha, Method::newton, 0, true).newton_steps, 2u);
        expect_near(z, solution, 1e-8);
      }
      EXPECT_GE(std::min({all.open, all.stick, all.slip}), 5u) << mu; // all are there
      EXPECT_LE(fell_back, mu <= 1. ? 0u : 10u);
    }
}

/** Limits with a kink, with friction where nothing presses, and along a curve, in every state, by both methods. */
TEST(CoulombSolver, SolvesLimitedCohesiveAndCurvedCones)
{
  Vector<double> z, other, alpha;
  for (const hpvi::FrictionLimit &friction :
       {hpvi::FrictionLimit{0., 0.3, 0.1}, hpvi::FrictionLimit{0.05, 0.3},
        hpvi::FrictionLimit{0., 0.5, infinity, [](const double p) { return 1. / (1. + 3. * p); }}})
    for (const bool bilateral : {false, true})
    {
      unsigned int stick = 0, capped = 0, open = 0, slip = 0, fell_back = 0;
      for (unsigned int seed = 0; seed < 30; ++seed)
      {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const ConeProgram cones = random_cones(seed, friction, bilateral);
        const CoulombReport report = solve(cones, z, alpha);
        EXPECT_TRUE(report.qp.converged) << report.residual;
        expect_solution(cones, z, alpha);
        fell_back += report.qp.fell_back;
        for (const auto &[t, normal, limit] : cones.set.cones)
          ++(std::abs(z[t]) < limit.limit(z[normal]) ? stick
             : z[normal] <= 0.                       ? open
             : limit.is_capped(z[normal])            ? capped
                                                     : slip);
        EXPECT_TRUE(solve(cones, other, alpha, Method::fixed_point).qp.converged);
        expect_near(z, other, 1e-7);
      }
      EXPECT_GE(std::min({stick, open, slip}), 5u);
      EXPECT_TRUE(std::isinf(friction.most) || capped >= 5u) << capped;
      EXPECT_EQ(fell_back, 0u);
    }
}

/** Where the fixed point contracts there is one solution. */
TEST(CoulombSolver, FixedPointAgrees)
{
  Vector<double> z, other, alpha;
  for (const double mu : {0.05, 0.3, 0.6})
    for (unsigned int seed = 0; seed < 100; ++seed)
    {
      SCOPED_TRACE("mu = " + std::to_string(mu) + ", seed " + std::to_string(seed));
      const ConeProgram cones = random_cones(seed, mu);
      EXPECT_TRUE(solve(cones, z, alpha).qp.converged);
      const CoulombReport report = solve(cones, other, alpha, Method::fixed_point);
      EXPECT_TRUE(report.qp.converged) << report.residual;
      EXPECT_EQ(report.method, "fixed point");
      EXPECT_LT(report.contraction, 1.);
      EXPECT_LE(report.fixed_point_steps, 40u);
      expect_solution(cones, other, alpha);
      expect_near(z, other, 1e-7);
    }
}

TEST(CoulombSolver, FixedPointGivesUpWhereItDoesNotContract)
{
  Vector<double> z, alpha;
  unsigned int failures = 0;
  for (unsigned int seed = 0; seed < 30; ++seed)
  {
    const ConeProgram cones = random_cones(seed, 20.);
    const CoulombReport report = solve(cones, z, alpha, Method::fixed_point);
    EXPECT_LE(report.fixed_point_steps, 200u);
    failures += !report.qp.converged;
    if (report.qp.converged)
      expect_solution(cones, z, alpha);
    else
    {
      EXPECT_GT(report.contraction, 1.);
    }
  }
  EXPECT_GT(failures, 0u);
}

TEST(CoulombSolver, HalfPlane)
{
  Vector<double> z, alpha;
  for (const double mu : {0.1, 0.5, 1.})
  {
    const ConeProgram cones = half_plane(mu, 0.3, 0.4 * mu);
    const CoulombReport report = solve(cones, z, alpha);
    EXPECT_TRUE(report.qp.converged);
    EXPECT_EQ(report.method, "newton");
    EXPECT_LE(report.newton_steps, 25u);
    expect_solution(cones, z, alpha);
    EXPECT_GT(count(cones, z).open, 0u);
  }
}

/** Each rung solves problems without those before it, and each is needed. */
TEST(CoulombSolver, RungsOfTheLadder)
{
  const std::vector<std::string> names = {"newton", "newton from frictionless", "line search",
                                          "anderson", "continuation"};
  Vector<double> z, alpha;
  for (unsigned int rung = 0; rung < names.size(); ++rung)
    for (unsigned int seed = 0; seed < 5; ++seed)
    {
      const ConeProgram cones = random_cones(seed, 0.7);
      const CoulombReport report = solve(cones, z, alpha, Method::newton, rung);
      EXPECT_TRUE(report.qp.converged);
      EXPECT_EQ(report.method, names[rung]);
      EXPECT_EQ(report.qp.fell_back, rung > 0);
      expect_solution(cones, z, alpha);
    }
  std::map<std::string, unsigned int> ends;
  unsigned int unsolved = 0;
  for (unsigned int seed = 0; seed < 150; ++seed)
  {
    const ConeProgram cones = random_cones(seed, 10.);
    const CoulombReport report = solve(cones, z, alpha);
    if (report.qp.converged)
    {
      SCOPED_TRACE("seed " + std::to_string(seed));
      expect_solution(cones, z, alpha);
      ++ends[report.method];
    }
    unsolved += !report.qp.converged;
    EXPECT_LE(report.newton_steps, 3000u);
  }
  EXPECT_LE(unsolved, 7u); // with such friction there need not be a solution
  for (const std::string &name : names)
    EXPECT_GT(ends[name], 0u) << name;
}

/** S = I: every point by itself. */
TEST(CoulombSolver, OpenStickAndSlip)
{
  Vector<double> z, alpha;
  for (const Method method : {Method::newton, Method::fixed_point})
  {
    const auto expect =
        [&](const Vector<double> &d, const Vector<double> &solution, const bool bilateral = false)
    {
      LAPACKFullMatrix<double> S(d.size());
      for (unsigned int i = 0; i < d.size(); ++i)
        S(i, i) = 1.;
      const ConeProgram cones = program(S, d, {0., 0.5}, bilateral);
      EXPECT_TRUE(solve(cones, z, alpha, method).qp.converged);
      expect_near(z, solution, 1e-12);
      expect_solution(cones, z, alpha);
    };
    expect(vec({1., -1., -2., -3.}), vec({0., 0., 0., 0.}));
    expect(vec({1., -1., 4., 4.}), vec({1., -1., 4., 4.}));
    expect(vec({3., -3., 4., 2.}), vec({2., -1., 4., 2.}));
    expect(vec({2., 0., 4., 0.}), vec({2., 0., 4., 0.})); // at the limit, and grazing
    expect(vec({3., 3., -3., 4., -4., 1.}), vec({2., 0., -0.5, 4., -4., 1.}), true);
    expect(vec({0., 0.}), vec({0., 0.}));
  }
}

TEST(CoulombSolver, NoFrictionNothingAndNotANumber)
{
  Vector<double> z, alpha;
  ConeProgram cones = random_cones(1, 0.);
  EXPECT_TRUE(solve(cones, z, alpha).qp.converged);
  for (const auto &cone : cones.set.cones)
    EXPECT_EQ(z[cone.tangential], 0.);
  expect_solution(cones, z, alpha);
  EXPECT_TRUE(solve(ConeProgram(), z, alpha).qp.converged);
  for (const double bad : {not_a_number, infinity})
    for (const Method method : {Method::newton, Method::fixed_point})
    {
      cones = random_cones(1, 0.3);
      cones.S(3, 3) = bad;
      const CoulombReport report = solve(cones, z, alpha, method);
      EXPECT_FALSE(report.qp.converged);
      EXPECT_TRUE(std::isnan(report.residual));
      cones = random_cones(1, 0.3);
      cones.d[2] = bad;
      EXPECT_FALSE(solve(cones, z, alpha, method).qp.converged);
    }
}

/** A block on two points of a slope. */
ConeProgram block(const double mu, const double slope, const double clearance)
{
  const double angle = std::atan(slope);
  LAPACKFullMatrix<double> S(4);
  for (unsigned int i = 0; i < 4; ++i)
    S(i, i) = 1.;
  ConeProgram cones = program(S, vec({0., 0., -clearance, -clearance}), {0., mu});
  cones.balance.G.reinit(4, 3);
  for (unsigned int i = 0; i < 2; ++i)
  {
    cones.balance.G(i, 0) = 1.;
    cones.balance.G(2 + i, 1) = 1.;
    cones.balance.G(2 + i, 2) = i == 0 ? -1. : 1.;
  }
  cones.balance.e = vec({std::sin(angle), std::cos(angle), 0.2});
  cones.penalty.reinit(3, 3);
  for (unsigned int j = 0; j < 3; ++j)
  {
    cones.penalty(j, j) = 2.;
    for (unsigned int i = 0; i < 4; ++i)
    {
      cones.d[i] += 2. * cones.balance.G(i, j) * cones.balance.e[j];
      for (unsigned int k = 0; k < 4; ++k)
        cones.S(i, k) += 2. * cones.balance.G(i, j) * cones.balance.G(k, j);
    }
  }
  return cones;
}

TEST(CoulombSolver, BlockOnASlope)
{
  Vector<double> z, alpha;
  for (const Method method : {Method::newton, Method::fixed_point})
    for (const double clearance : {0., 50.})
    {
      // Beyond the one point's limit the other takes more; beyond both the block slides.
      for (const double mu : {0.301, 0.35, 0.6, 5.})
      {
        SCOPED_TRACE("mu = " + std::to_string(mu) + ", clearance " + std::to_string(clearance));
        const ConeProgram cones = block(mu, 0.3, clearance);
        EXPECT_TRUE(solve(cones, z, alpha, method).qp.converged);
        expect_solution(cones, z, alpha);
        EXPECT_NEAR(z[0] + z[1], std::sin(std::atan(0.3)), 1e-9);
        EXPECT_NEAR(z[2] + z[3], std::cos(std::atan(0.3)), 1e-9);
      }
      EXPECT_FALSE(solve(block(0.29, 0.3, clearance), z, alpha, method).qp.converged);
    }
}
} // namespace
