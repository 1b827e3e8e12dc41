// SPDX-License-Identifier: LGPL-2.1-or-later
// Coulomb friction against closed forms, a published benchmark, statics and its own conditions.
#include "coulomb_law.h"
#include <hpvi/reader/closed_forms/hertz.h>
#include <hpvi/reader/closed_forms/partial_slip.h>
#include <hpvi/reader/closed_forms/stick_slip.h>

#include <hpvi/results/solution_field.h>

namespace
{
using namespace verification;

void expect_exponential(const std::vector<double> &energies, const double exact, const double last)
{
  EXPECT_LE(std::abs(energies.back() - exact), last * exact);
  EXPECT_LE(std::abs(energies.back() - exact), 1e-4 * std::abs(energies.front() - exact));
}

// ---------------------------------------------------------------- closed forms

/** Friction -f p everywhere under Hertz's pressure p, which a gap that is not symmetric leaves as it was. */
TEST(CoulombFriction, SlipsUnderHertzPressure)
{
  const double f = 0.3, a = 0.7, p_0 = 7, U = 0.03;
  Scene<2> scene;
  scene.geometry.corners = box_corners<2>({-2, 0}, {2, 2});
  scene.geometry.subdivisions = {{4, 2}};
  scene.materials = {{200, 0.3, PlaneModel::strain}};
  const Material &material = scene.materials[0];
  const auto hertz = std::make_shared<Hertz>(material, p_0, a, 0.);
  // Without a stick zone: one of 1e-7 a differs by less than round-off.
  const auto friction = std::make_shared<PartialSlip>(material, f * p_0, a, 1e-7 * a, 0.);
  prescribe(scene, [=](const Point<2> &x)
            { return hertz->displacement(x) + friction->displacement(x) + Point<2>(U, 0); });
  BoundaryCondition<2> &bottom = scene.boundary("bottom");
  bottom.contact = Contact::unilateral;
  bottom.friction.coefficient = expression<2>(f);
  const double k = p_0 / a, mu = material.mu(), kappa = material.kolosov(),
               R = 200 / (2 * (1 - 0.09) * k);
  bottom.gap = expression<2>(
      [=](const Point<2> &x)
      {
        const double s = x[0], inside = s * std::sqrt(std::max(0., a * a - s * s)) / 2 +
                                        a * a / 2 * std::asin(std::clamp(s / a, -1., 1.));
        return s * s / (2 * R) + f * (kappa - 1) * k / (4 * mu) * inside;
      });
  scene.adaptivity.maximum_steps = 18;
  const Outcome outcome = run(scene);
  expect_exponential(outcome.elastic_energy, 0.149120752172, 1e-9);
  const double P = 7.6969020013;
  EXPECT_NEAR(outcome.contact.normal_resultant, -P, 1e-7 * P);
  EXPECT_NEAR(outcome.contact.friction_resultant, -f * P, 1e-7 * P);
  ASSERT_EQ(outcome.contact.zones.size(), 3u);
  EXPECT_EQ(outcome.contact.zones[1].mode, ContactMode::slip);
  EXPECT_NEAR(outcome.contact.zones[1].begin[0], -a, 1e-3 * a);
  EXPECT_NEAR(outcome.contact.zones[1].end[0], a, 1e-3 * a);
}

/** The stick-slip field with a uniform pressure q: f = g/p(x) makes Coulomb's bound the constant g. */
TEST(CoulombFriction, SticksAndSlipsWithAVariableCoefficient)
{
  const double g = 0.3, q = 1;
  for (const Contact contact : {Contact::unilateral, Contact::bilateral})
  {
    Scene<2> scene;
    scene.geometry.corners = box_corners<2>({-1, 0}, {1, 1});
    scene.geometry.subdivisions = {{4, 2}};
    scene.materials = {{1, 0.3, PlaneModel::stress}};
    const Material &material = scene.materials[0];
    const auto field = std::make_shared<StickSlip>(material, g, 0., 1.);
    const double stiffness = material.lambda(2) + 2 * material.mu(), kappa = material.kolosov(),
                 A = g / (1.5 * (1 + kappa));
    prescribe(scene, [=](const Point<2> &x)
              { return field->displacement(x) - Point<2>(0, q * x[1] / stiffness); });
    BoundaryCondition<2> &bottom = scene.boundary("bottom");
    bottom.contact = contact;
    bottom.friction.coefficient =
        expression<2>([=](const Point<2> &x)
                      { return g / (q - 1.5 * (kappa - 1) * A * std::sqrt(std::max(0., -x[0]))); });
    scene.adaptivity.maximum_steps = 20;
    const Outcome outcome = run(scene);
    expect_exponential(outcome.elastic_energy, 0.928311113728, 1e-8);
    ASSERT_EQ(outcome.contact.transitions.size(), 1u);
    EXPECT_NEAR(outcome.contact.transitions[0][0], 0, 1e-4);
  }
}

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
  const double slope = 0.1, weight = 3 * 0.5;
  const Turned body{"wedge", {{{0, 0}, {3, 0}, {3, 0.5}, {0, 0.5}}}, std::atan(slope)};
  for (const double f : {0.1, 0.2, 0.3})
  {
    const double limit = (slope + f) / (1 - f * slope);
    const auto scene = [&](const double push)
    {
      Scene<2> scene;
      scene.geometry = body.geometry(4, 1);
      scene.materials = {{1000, 0.3, PlaneModel::strain}};
      scene.body_force = {{expression<2>(push), expression<2>(-1.)}};
      scene.boundary("bottom").contact = Contact::unilateral;
      scene.boundary("bottom").friction.coefficient = expression<2>(f);
      scene.adaptivity.maximum_steps = 2;
      return scene;
    };
    EXPECT_EQ(failure_of(scene(limit * (1 - 1e-10))), "") << f;
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
