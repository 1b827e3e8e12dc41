// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cones.h"

namespace
{
using namespace algebra;

/**
 * One point of a body that turns as it is pushed, `S = (1, -1/2; -1/2, 1)`, dragged with d_t = t and 1/2
 * away from the plane. With mu = 3, as `mu |S_tn| > S_nn`, it presses the harder the more it slips:
 *
 *     open (0, 0);   slip z_n = 1, z_t = 3, if t >= 5/2;   stick S^-1 d, if that is in the cone.
 */
ConeProgram wedge(const double t)
{
  LAPACKFullMatrix<double> S(2);
  S(0, 0) = S(1, 1) = 1.;
  S(0, 1) = S(1, 0) = -0.5;
  return program(S, vec({t, -0.5}), {0., 3.});
}

CoulombSolver solver()
{
  return CoulombSolver(with_tolerance(1e-10), Method::newton);
}

TEST(Uniqueness, OfAWedgeThatMayOpenOrJam)
{
  const ConeProgram cones = wedge(2.7);
  Vector<double> z, alpha;
  EXPECT_TRUE(solve(cones, z, alpha).qp.converged); // from stick
  expect_near(z, vec({2.45 / 0.75, 0.85 / 0.75}), 1e-12);
  expect_solution(cones, z, alpha);
  EXPECT_NEAR(solver().difference_from_second_start(cones, z), 1., 1e-12); // from open
  expect_solution(cones, vec({0., 0.}), alpha);
  expect_solution(cones, vec({3., 1.}), alpha);
  // The open one is what the second start finds itself.
  EXPECT_EQ(solver().difference_from_second_start(cones, vec({0., 0.})), 0.);
  // |z' - z|_S over the larger of both: |(1, 1/3)|_S and |(3, 1)|_S with z' = 0 know only 1.
  EXPECT_NEAR(solver().difference_from_second_start(cones, vec({3., 1.})), 1., 1e-12);
}

/** Dragged the other way the point opens, whatever the start. */
TEST(Uniqueness, OfAWedgeThatOpens)
{
  const ConeProgram cones = wedge(-2.7);
  Vector<double> z, alpha;
  EXPECT_TRUE(solve(cones, z, alpha).qp.converged);
  expect_near(z, vec({0., 0.}), 0.);
  EXPECT_EQ(solver().difference_from_second_start(cones, z), 0.);
}

TEST(Uniqueness, OfRandomProblems)
{
  Vector<double> z, alpha;
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    const ConeProgram cones = random_cones(seed, 0.3);
    EXPECT_TRUE(solve(cones, z, alpha).qp.converged);
    EXPECT_LE(solver().difference_from_second_start(cones, z), 1e-8) << seed;
    Vector<double> wrong(z);
    wrong *= 1.1;
    EXPECT_NEAR(solver().difference_from_second_start(cones, wrong), 0.1 / 1.1, 1e-7) << seed;
  }
  unsigned int several = 0;
  for (unsigned int seed = 0; seed < 150; ++seed)
  {
    const ConeProgram cones = random_cones(seed, 5.);
    if (!solve(cones, z, alpha).qp.converged)
      continue;
    const double difference = solver().difference_from_second_start(cones, z);
    several += difference > CoulombReport::same;
    // One or two, and nothing in between.
    EXPECT_TRUE(std::isnan(difference) || difference < 1e-8 || difference > 1e-3)
        << seed << ": " << difference;
  }
  EXPECT_GT(several, 0u);
}

TEST(Uniqueness, IsNotKnownWithoutASolution)
{
  // Beyond the angle of friction there is no equilibrium.
  ConeProgram cones = wedge(1.);
  cones.balance.G.reinit(2, 1);
  cones.balance.G(0, 0) = 1.;
  cones.balance.e = vec({1e3});
  cones.penalty.reinit(1, 1);
  cones.penalty(0, 0) = 1.;
  cones.set.cones[0].friction.coefficient = 0.;
  EXPECT_TRUE(std::isnan(solver().difference_from_second_start(cones, vec({0., 0.}))));
}
} // namespace
