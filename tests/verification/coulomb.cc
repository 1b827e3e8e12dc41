// SPDX-License-Identifier: LGPL-2.1-or-later
// Coulomb friction against a published benchmark, statics and its own conditions.
#include "coulomb_law.h"

#include <hpvi/results/solution_field.h>

namespace
{
using namespace verification;

// ---------------------------------------------------------------- a published benchmark

/** code_aster's SSNV128; figures of an independent hp code to five digits, two of them of a second code. */
TEST(CoulombFriction, IsThatOfSsnv128)
{
  for (const std::string method : {"newton", "fixed point"})
  {
    const Overrides steps = {{"Adaptivity/Maximum steps", "17"}, {"Solver/Coulomb solver", method}};
    const Scene<2> scene = shipped_scene("ssnv128", steps);
    const Outcome outcome = run(scene);
    EXPECT_NEAR(outcome.contact.friction_resultant, -1405.346, 1e-3);
    EXPECT_NEAR(outcome.contact.normal_resultant, -2000, 1e-6);
    const auto &zones = outcome.contact.zones;
    ASSERT_EQ(zones.size(), 3u) << method;
    EXPECT_EQ(zones[0].mode, ContactMode::open);
    EXPECT_NEAR(zones[0].end[0], 3.323, 1e-3);
    EXPECT_EQ(zones[1].mode, ContactMode::slip);
    EXPECT_NEAR(zones[1].end[0], 29.857, 1e-3);
    EXPECT_EQ(zones[2].mode, ContactMode::stick);
    const std::vector<std::pair<double, double>> published = {
        {1.25, 27.2259e-3}, {5, 22.8683e-3}, {7.5, 19.8076e-3}, {11.25, 15.4140e-3}};
    const auto &points = outcome.contact.points;
    for (const auto &[x, u] : published)
      for (unsigned int k = 1; k < points.size(); ++k)
        if (const double left = points[k - 1].x[0], right = points[k].x[0]; left <= x && x < right)
        {
          const double s = (x - left) / (right - left),
                       u_t = (1 - s) * points[k - 1].tangential_displacement +
                             s * points[k].tangential_displacement;
          EXPECT_NEAR(u_t, u, 3e-3 * u) << x; // between two points of the table
        }
  }
}

// ---------------------------------------------------------------- statics

/** A block on a slope of angle a: it stays where mu_f > tan a, and goes where not. */
TEST(CoulombFriction, HoldsABlockUpToItsAngle)
{
  for (const double angle : {0.1, 0.5})
  {
    const Turned body{"block", {{{0, 0}, {3, 0}, {3, 0.5}, {0, 0.5}}}, angle};
    const auto scene = [&](const double coefficient)
    {
      Scene<2> scene;
      scene.geometry = body.geometry(4, 1);
      scene.materials = {{1000, 0.3, PlaneModel::strain}};
      scene.body_force[1] = expression<2>(-1.);
      scene.boundary("bottom").contact = Contact::unilateral;
      scene.boundary("bottom").friction.coefficient = expression<2>(coefficient);
      scene.adaptivity.maximum_steps = 3;
      return scene;
    };
    const Outcome outcome = run(scene(1.05 * std::tan(angle)));
    EXPECT_NEAR(outcome.contact.normal_resultant, -1.5 * std::cos(angle), 1e-9);
    EXPECT_NEAR(std::abs(outcome.contact.friction_resultant), 1.5 * std::sin(angle), 1e-9);
    EXPECT_EQ(failure_of(scene(std::tan(angle) * (1 + 1e-6))), "");
    const std::string failure = failure_of(scene(std::tan(angle) * (1 - 1e-6)));
    const auto number_after = [&](const std::string &words)
    {
      const std::size_t found = failure.find(words);
      return found == std::string::npos ? NAN : std::stod(failure.substr(found + words.size()));
    };
    const double mu = number_after("friction resists with "), N = 1.5 * std::cos(angle);
    EXPECT_EQ(failure.find("no equilibrium: sliding along bottom: "), 0U) << failure;
    EXPECT_NEAR(number_after("the loads push with "), 1.5 * std::sin(angle), 1e-8) << failure;
    EXPECT_NEAR(mu, std::tan(angle) * (1 - 1e-6), 1e-8) << failure;
    EXPECT_NEAR(number_after(" * "), N, 1e-8) << failure;
    EXPECT_NEAR(number_after(" = "), mu * N, 1e-8) << failure;
    EXPECT_NE(failure.find("raise Friction coefficient"), std::string::npos) << failure;
    EXPECT_EQ(failure.find("Friction bound"), std::string::npos) << failure;
  }
}

/** NAFEMS CGS-4: a wedge of slope tan a = 0.1 takes the push F = G (tan a + f)/(1 - f tan a) to move. */
TEST(CoulombFriction, HoldsAWedgeUpToItsPush)
{
  const double weight = 3 * 0.5;
  for (const auto &[slope, f] : {std::pair{0., 0.3}, {0.1, 0.1}, {0.1, 0.2}, {0.1, 0.3}})
  {
    const Turned body{"wedge", {{{0, 0}, {3, 0}, {3, 0.5}, {0, 0.5}}}, std::atan(slope)};
    const double limit = (slope + f) / (1 - f * slope), coefficient = f;
    const auto scene = [&](const double push)
    {
      Scene<2> scene;
      scene.geometry = body.geometry(4, 1);
      scene.materials = {{1000, 0.3, PlaneModel::strain}};
      scene.body_force = {{expression<2>(push), expression<2>(-1.)}};
      scene.boundary("bottom").contact = Contact::unilateral;
      scene.boundary("bottom").friction.coefficient = expression<2>(coefficient);
      scene.adaptivity.maximum_steps = 2;
      return scene;
    };
    const ContactState<2> contact = run(scene(limit * (1 - 1e-10))).contact; // all points rub
    EXPECT_NEAR(contact.friction_resultant, f * contact.normal_resultant, 1e-9);
    EXPECT_NE(failure_of(scene(limit * (1 + 1e-10))).find("no equilibrium"), std::string::npos)
        << f;
    EXPECT_NEAR(run(scene(0.9 * limit)).contact.normal_resultant,
                -weight * (1 + 0.9 * limit * slope) / std::hypot(1, slope), 1e-9);
  }
}

// ---------------------------------------------------------------- round-off

/** What no refinement can lower must be as small as round-off, or a run would end with its first steps. */
TEST(CoulombFriction, LeavesTheFloorOfTheIndicatorAtRoundOff)
{
  for (const std::string contact : {"unilateral", "bilateral"})
    each_step<2>(shipped_scene("ssnv128", {{"Boundary bottom/Contact", contact},
                                           {"Adaptivity/Maximum steps", "1"}}),
                 [&](const StepReport<2> &step)
                 {
                   const double floor = round_off_of_estimate(step.field);
                   EXPECT_GT(floor, 0.) << contact;
                   EXPECT_LT(floor, 1e-10 * step.estimate.total()) << contact;
                 });
}

// ---------------------------------------------------------------- uniform states

/** A sheared block: it sticks below f p, slides above, and a bilateral contact that pulls rubs nowhere. */
TEST(CoulombFriction, OfAUniformStressIsExact)
{
  const double f = 0.4;
  for (const Contact contact : {Contact::unilateral, Contact::bilateral})
    for (const double p : {1., -1.})
      for (const double shear : {0.3, 0.5})
      {
        if (p < 0 && contact == Contact::unilateral)
          continue; // it would open
        Scene<2> scene;
        scene.geometry.corners = box_corners<2>({0, 0}, {2, 1});
        scene.geometry.subdivisions = {{2, 1}};
        scene.materials = {{1, 0, PlaneModel::strain}}; // mu = 1/2
        const double friction = p > 0 ? std::min(shear, f * p) : 0., slip = 0.07;
        const bool slips = friction < shear || p < 0;
        BoundaryCondition<2> &bottom = scene.boundary("bottom"), &top = scene.boundary("top");
        bottom.contact = contact;
        bottom.friction.coefficient = expression<2>(f);
        top.displacement = {{expression<2>(2 * friction + (slips ? slip : 0.)), expression<2>(-p)}};
        scene.boundary("left").traction[1] = expression<2>(-friction);
        scene.boundary("right").traction[1] = expression<2>(friction);
        scene.adaptivity.maximum_steps = 1;
        const Outcome outcome = run(scene);
        for (const ContactPoint<2> &point : outcome.contact.points)
        {
          EXPECT_NEAR(point.normal_traction, -p, 1e-12);
          EXPECT_NEAR(point.tangential_traction, -friction, 1e-12);
          EXPECT_NEAR(point.tangential_displacement, slips ? slip : 0., 1e-12);
          EXPECT_EQ(point.mode(), slips ? ContactMode::slip : ContactMode::stick);
        }
      }
}
} // namespace
