// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies that friction alone holds: balance of forces, the friction limit, and what lies beyond.
#include "friction_quadrature.h"

#include <hpvi/base/numerical_failure.h>

#include <numeric>

namespace
{
using namespace verification;

struct LastStep
{
  double resultant, slack, largest_u, norm;
  std::vector<double> lambda;
  std::vector<std::string> warnings;
};

LastStep run(const Scene<2> &scene)
{
  LastStep last;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        const Solution<2> &solution = step.solution();
        expect_slack_of_overshoot_alone(solution, step.energies.slack);
        last = {step.contact.at(0).friction_resultant,
                step.energies.slack,
                solution.u.linfty_norm(),
                step.energies.norm,
                {solution.z.begin(), solution.z.end()},
                texts(step.warnings)};
      });
  return last;
}

/** A block on friction g = 0.3 in pure shear tau, by tractions on the three other sides. */
Scene<2> sheared_block(const double tau, const Overrides &more = {})
{
  Overrides entries = {given::box("2, 1", "4, 2"),
                       given::elastic("1", "0.25"),
                       {"Boundary left/Traction", "0; " + in_digits(-tau)},
                       {"Boundary right/Traction", "0; " + in_digits(tau)},
                       {"Boundary top/Traction", in_digits(tau) + "; 0"},
                       given::rough("bottom", "bilateral", "0.3"),
                       given::steps("hpa2", "2")};
  entries.insert(entries.end(), more.begin(), more.end());
  return scene_of(entries);
}

TEST(Semicoercive, StickingBlockShearsAndStays)
{
  const double tau = 0.2, mu = 0.4; // E/(2(1+nu))
  const LastStep last = run(sheared_block(tau));
  EXPECT_NEAR(last.largest_u, tau / mu, 1e-9);
  EXPECT_NEAR(last.resultant, -2 * tau, 1e-10);
  for (const double z : last.lambda)
    EXPECT_NEAR(z, tau, 1e-8);
  EXPECT_FALSE(mentions(last.warnings, "not unique"));
}

TEST(Semicoercive, AtTheFrictionLimitThePlaceIsNotUnique)
{
  const LastStep last = run(sheared_block(0.3));
  for (const double z : last.lambda)
    EXPECT_NEAR(z, 0.3, 1e-8);
  EXPECT_TRUE(mentions(last.warnings, "not unique"));
}

TEST(Semicoercive, BeyondTheFrictionLimitThereIsNoEquilibrium)
{
  const std::string line = failure_of(sheared_block(0.31));
  for (const std::string words : {"no equilibrium", "0.62", "0.6;"}) // applied, available
    EXPECT_TRUE(says(line, words)) << line;
}

TEST(Semicoercive, OnePartInAMillionBeyondTheLimitIsBeyondIt)
{
  EXPECT_NO_THROW(run(sheared_block(0.3 * (1 - 1e-6))));
  const std::string line = failure_of(sheared_block(0.3 * (1 + 1e-6)));
  EXPECT_TRUE(says(line, "no equilibrium")) << line; // and not that a solver has given up
}

/** The shipped bar at its limit: a point or two may miss |lambda| = 1 by more than round-off. */
TEST(Semicoercive, TheLimitIsSeenOnAdaptiveMeshes)
{
  const auto warned = [](const std::string &t)
  {
    return mentions(
        run(shipped_scene("semicoercive", {{"Boundary top/Traction", t + "; 0"}})).warnings,
        "not unique");
  };
  EXPECT_TRUE(warned("1.75"));
  EXPECT_FALSE(warned("1.749999"));
}

/** The translation of one mesh starts the next: it is counted from the mean of u_t on each. */
TEST(Semicoercive, TheTranslationOfAStepStartsTheNext)
{
  std::vector<unsigned int> solves;
  each_step<2>(shipped_scene("semicoercive"),
               [&](const StepReport<2> &step) { solves.push_back(step.reduced->qp.dense_solves); });
  ASSERT_GE(solves.size(), 12u);
  EXPECT_LE(std::accumulate(solves.begin() + 4, solves.end(), 0u), 6 * (solves.size() - 4));
}

/** The bar of Example 5.3 without its clamp: t along the top is all that friction has to carry. */
using UnclampedBar = ::testing::TestWithParam<double>;

TEST_P(UnclampedBar, FrictionBalancesTheLoads)
{
  const double t = GetParam() * 1.75;
  const LastStep last =
      run(shipped_scene("semicoercive", {{"Boundary top/Traction", in_digits(t) + "; 0"}}));
  EXPECT_NEAR(last.resultant, -10 * t, 1e-8);
  for (const double z : last.lambda)
    EXPECT_LE(std::abs(z), 1.75);
  // The translation is right where slipping points slip with friction, not against it.
  EXPECT_LE(last.slack, 1e-4 * last.norm * last.norm);
}

INSTANTIATE_TEST_SUITE_P(, UnclampedBar, ::testing::Values(-0.9, 0., 0.9, 0.999, 1.));

/** The same bar turned by 30 degrees: the free translation follows the contact boundary. */
TEST(Semicoercive, DoesNotDependOnTheAxes)
{
  const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
  const auto turned = [&](const double x, const double y)
  { return in_digits(c * x - s * y) + ", " + in_digits(s * x + c * y); };
  const std::string corners =
      turned(0, 0) + "; " + turned(2, 0) + "; " + turned(2, 1) + "; " + turned(0, 1);
  const double tau = 0.2, mu = 0.4;
  const auto force = [&](const double x, const double y)
  { return in_digits(c * x - s * y) + "; " + in_digits(s * x + c * y); };
  const LastStep last = run(sheared_block(tau, {given::quadrilateral("Geometry", corners),
                                                {"Boundary left/Traction", force(0, -tau)},
                                                {"Boundary right/Traction", force(0, tau)},
                                                {"Boundary top/Traction", force(tau, 0)}}));
  EXPECT_NEAR(last.largest_u, c * tau / mu, 1e-9);
  EXPECT_NEAR(std::abs(last.resultant), 2 * tau, 1e-10);
}

/** sin(2 pi x) pushes with 3e-18, which is none: without a pressure Coulomb's friction resists with 0. */
TEST(Semicoercive, LoadsThatCancelToRoundOffPushNothing)
{
  const Scene<2> scene = scene_of({{"Geometry/Subdivisions", "3, 2"},
                                   {"Boundary bottom/Contact", "unilateral"},
                                   {"Boundary bottom/Friction coefficient", "0.3"},
                                   {"Boundary top/Traction", "sin(2*pi*x); 0"},
                                   {"Adaptivity/Maximum steps", "1"}});
  AdaptiveSolver<2>(scene).run(
      [](const StepReport<2> &step) {
        EXPECT_TRUE(
            mentions(texts(step.warnings), "not unique; raise Friction coefficient, lower"));
      });
}

TEST(Semicoercive, MotionsThatNothingResistsAreBadInput)
{
  EXPECT_THROW(sheared_block(0.1, {{"Boundary bottom/Friction bound", ""}}), InputError);
  EXPECT_THROW(sheared_block(0.1, {{"Boundary bottom/Friction bound", ""},
                                   {"Boundary bottom/Contact", "none"}}),
               InputError);
}
} // namespace
