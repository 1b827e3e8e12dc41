// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies that contact alone holds: what holds them, and what no contact can hold.
#include "opening_contact.h"

#include <hpvi/base/numerical_failure.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/results/solution_field.h>

#include <algorithm>

namespace
{
using namespace verification;

const Material material{100., 0.3, PlaneModel::strain};
const double lambda = material.lambda(2), mu = material.mu();
// Strains of plane strain from stresses without shear: eps_x = along sigma_x + across sigma_y.
const double along = (1 - 0.3 * 0.3) / 100, across = -0.3 * 1.3 / 100;

Turned rectangle(const double width, const double height, const double angle = 0)
{
  return {"Rectangle", {{{0, 0}, {width, 0}, {width, height}, {0, height}}}, angle};
}

Scene<2> scene_of_body(const Turned &body, const NormalContact normal)
{
  Scene<2> scene;
  scene.geometry = body.geometry(2, 2);
  scene.materials = {material};
  scene.solver.normal_contact = normal;
  scene.adaptivity.maximum_steps = 1;
  return scene;
}

struct Outcome
{
  std::vector<ContactState<2>> contact;
  Equilibrium<2> equilibrium;
  std::vector<std::string> warnings;
  Vector<double> u, z;
  double norm;
};

/** The last step of a run. */
Outcome run(const Scene<2> &scene)
{
  Outcome last;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        last = {step.contact,      step.equilibrium,  texts(step.warnings),
                step.solution().u, step.solution().z, step.energies.norm};
      });
  return last;
}

/** On a random mesh: u to the round-off that a soft spring leaves, and all conditions. */
Outcome expect_field(const Scene<2> &scene, const Turned &body,
                     const std::function<Tensor<1, 2>(const Point<2> &)> &field)
{
  check(scene);
  const RandomMesh mesh(scene, 8, 2);
  const Laboratory discrete(scene, mesh);
  const Solution<2> solution = discrete.solve();
  EXPECT_LE(
      nodal_error(solution, [&](const Point<2> &x) { return body.turned(field(body.own(x))); }),
      1e-9);
  expect_complementary(solution);
  expect_equilibrium(solution, discrete.system.loads());
  const Equilibrium<2> balance =
      equilibrium(solution.scene, nodal_forces(solution, discrete.system));
  EXPECT_LE(balance.force_imbalance, 1e-10);
  EXPECT_LE(balance.moment_imbalance, 1e-10);
  return {contact_states(SolutionField(solution)), balance, {}, solution.u, solution.z, 0.};
}

/**
 * Weight rho on a curved floor that fits the block as it widens towards its foot: sigma_y = -rho (H - y)
 * alone, u quadratic, the same pressure rho H everywhere.
 */
void expect_uniform_pressure(const NormalContact normal, const double angle)
{
  const double rho = 2, H = 1;
  const Turned body = rectangle(2, H, angle);
  Scene<2> scene = scene_of_body(body, normal);
  scene.body_force = body.field([=](const Point<2> &) { return Point<2>(0, -rho); });
  scene.boundary("bottom").contact = Contact::unilateral;
  const auto bend = [=](const double x) { return across * rho * (x - 1) * (x - 1) / 2; };
  scene.boundary("bottom").gap = body.scalar([=](const Point<2> &x) { return bend(x[0]); });
  scene.boundary("bottom").friction.bound = expression<2>(0.); // no floor without friction is whole
  const auto field = [=](const Point<2> &x)
  {
    return Point<2>(-across * rho * (H - x[1]) * (x[0] - 1),
                    -along * rho * (H * x[1] - x[1] * x[1] / 2) - bend(x[0]));
  };
  const RandomMesh mesh(scene, 8, 2);
  const Laboratory discrete(scene, mesh);
  const Solution<2> solution = discrete.solve();
  expect_complementary(solution);
  expect_equilibrium(solution, discrete.system.loads());
  for (unsigned int i = 0; i < solution.z.size(); ++i)
    if (discrete.contact_space.multipliers()[i].kind == ContactMultiplier<2>::Kind::pressure)
    {
      EXPECT_NEAR(solution.z[i], rho * H, 1e-9 * rho * H);
    }
  // Its place along the floor is anywhere: that of its foot tells where.
  const Tensor<1, 2> floor = body.turned(Point<2>(1, 0));
  const ContactPoint<2> point = contact_states(SolutionField(solution)).at(0).points.front();
  const double moved = point.tangential_displacement - field(body.own(point.x))[0];
  EXPECT_LE(nodal_error(solution, [&](const Point<2> &x)
                        { return body.turned(field(body.own(x))) + moved * floor; }),
            1e-9);
  EXPECT_TRUE(mentions(run(scene).warnings, "not unique"));
}

class HeldByContact : public ::testing::TestWithParam<std::tuple<NormalContact, double>>
{
protected:
  const NormalContact normal = std::get<0>(GetParam());
  const double angle = std::get<1>(GetParam());

  /** A block 2 x 1 with the stress (-s, -p; tau), s such that nothing is strained along the plane. */
  Scene<2> pushed_block(const double p, const double tau, const double g) const
  {
    const Turned body = rectangle(2, 1, angle);
    Scene<2> scene = scene_of_body(body, normal);
    scene.boundary("bottom").contact = Contact::unilateral;
    scene.boundary("bottom").friction.bound = expression<2>(g);
    SymmetricTensor<2, 2> sigma;
    sigma[0][0] = -lambda / (lambda + 2 * mu) * p;
    sigma[1][1] = -p;
    sigma[0][1] = tau;
    for (const unsigned int k : {1U, 2U, 3U})
      scene.boundary(sides[k]).traction = body.traction(k, [=](const Point<2> &) { return sigma; });
    return scene;
  }

  /** A block 2 x 2 of weight 4, pushed by @p push in the middle of its left edge. */
  Scene<2> resting_block(const double push, const double lift = 0) const
  {
    const Turned body = rectangle(2, 2, angle);
    Scene<2> scene = scene_of_body(body, normal);
    scene.body_force = body.field([=](const Point<2> &) { return Point<2>(0, lift - 1); });
    scene.boundary("left").traction =
        body.field([=](const Point<2> &) { return Point<2>(push / 2, 0); });
    scene.boundary("bottom").contact = Contact::unilateral;
    scene.boundary("bottom").friction.bound = expression<2>(1.5);
    return scene;
  }
};

// ---------------------------------------------------------------- closed forms

/** Turned, the floor sees of the motion along it round-off alone, which is not to count. */
TEST_P(HeldByContact, ABlockUnderItsWeightPressesUniformly)
{
  expect_uniform_pressure(normal, angle);
}

/** A square stands on its corner in a trough that fits it: both sides press alike, all motions are held. */
TEST_P(HeldByContact, ASquareInATroughPressesBothSides)
{
  const double b = 3;
  const Turned body{"Square", {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}, numbers::PI / 4 + angle};
  Scene<2> scene = scene_of_body(body, normal);
  scene.body_force = body.field([=](const Point<2> &) { return Point<2>(-b, -b); });
  for (const unsigned int k : {0U, 1U})
  {
    BoundaryCondition<2> &side = scene.boundary(k == 0 ? "bottom" : "left");
    side.contact = Contact::unilateral;
    side.gap = body.scalar([=](const Point<2> &x) { return across * b * x[k] * x[k] / 2; });
  }
  const Outcome outcome = expect_field(scene, body,
                                       [=](const Point<2> &x)
                                       {
                                         Tensor<1, 2> u;
                                         for (unsigned int k = 0; k < 2; ++k)
                                           u[k] = -along * b * (x[k] - x[k] * x[k] / 2) -
                                                  across * b * (1 - x[1 - k]) * x[k] -
                                                  across * b * x[1 - k] * x[1 - k] / 2;
                                         return u;
                                       });
  for (const double z : outcome.z)
    EXPECT_NEAR(z, b, 1e-9 * b);
  EXPECT_FALSE(mentions(run(scene).warnings, "not unique"));
}

/** Friction and contact share the loads of a uniform stress: the foot stays where it was. */
TEST_P(HeldByContact, APushedBlockSticksAndStays)
{
  const double p = 2, tau = 0.5;
  const Scene<2> scene = pushed_block(p, tau, 0.6);
  const Outcome outcome = expect_field(
      scene, rectangle(2, 1, angle),
      [&](const Point<2> &x) { return Point<2>(tau / mu * x[1], -p / (lambda + 2 * mu) * x[1]); });
  const ContactState<2> &state = outcome.contact.at(0);
  EXPECT_NEAR(state.normal_resultant, -2 * p, 1e-9);
  EXPECT_NEAR(state.friction_resultant, -2 * tau, 1e-9);
  for (const ContactPoint<2> &point : state.points)
  {
    EXPECT_EQ(point.mode(), ContactMode::stick);
    EXPECT_NEAR(point.normal_traction, -p, 1e-9);
    EXPECT_NEAR(point.tangential_traction, -tau, 1e-9);
  }
  EXPECT_FALSE(mentions(run(scene).warnings, "not unique"));
}

// ---------------------------------------------------------------- limits

TEST_P(HeldByContact, AtTheFrictionLimitThePlaceIsNotUnique)
{
  const Outcome last = run(pushed_block(2, 0.6, 0.6));
  EXPECT_TRUE(mentions(last.warnings, "not unique"));
  EXPECT_NEAR(last.contact.at(0).friction_resultant, -1.2, 1e-9);
  EXPECT_NEAR(last.contact.at(0).normal_resultant, -4, 1e-9);
}

TEST_P(HeldByContact, BeyondTheFrictionLimitBothForcesAreNamed)
{
  const std::string line = failure_of(pushed_block(2, 0.7, 0.6));
  EXPECT_EQ(line, "no equilibrium: sliding along bottom: the loads push with 1.4, friction resists "
                  "with 1.2; add a support, raise Friction bound or lower the loads");
  EXPECT_NO_THROW(run(pushed_block(2, 0.6 * (1 - 1e-6), 0.6)));
  EXPECT_NE(failure_of(pushed_block(2, 0.6 * (1 + 1e-6), 0.6)).find("no equilibrium: sliding"),
            std::string::npos);
}

/** No entry is named that is not in the scene. */
TEST_P(HeldByContact, WithoutFrictionNothingIsSaidOfIt)
{
  Scene<2> scene = pushed_block(2, 0.7, 0.6);
  scene.boundary("bottom").friction.bound = nullptr;
  EXPECT_EQ(failure_of(scene), "no equilibrium: sliding along bottom: the loads push with 1.4, "
                               "nothing resists; add a support or change the loads");
}

TEST_P(HeldByContact, LoadsThatLiftTheBodyAreNamed)
{
  EXPECT_EQ(failure_of(resting_block(0, 1.25)), // a quarter of the weight is left
            "no equilibrium: lifting off bottom: the loads pull with 1, contact can only press; "
            "add a support or change the loads");
}

/** About the corner at its foot: the push has the moment P * 1 there, the weight 4 * 1. */
TEST_P(HeldByContact, ABlockTipsAboutItsCorner)
{
  const Turned body = rectangle(2, 2, angle);
  Scene<2> scene = resting_block(5);
  scene.boundary("bottom").friction.bound = expression<2>(10.);
  const std::string line = failure_of(scene);
  const std::string words = "no equilibrium: toppling about (", meets = " and meet bottom at (";
  ASSERT_EQ(line.find(words), 0U) << line;
  ASSERT_NE(line.find("): the loads turn the body with 1" + meets), std::string::npos) << line;
  const auto point_after = [&](const std::string &text)
  {
    std::istringstream place(line.substr(line.find(text) + text.size()));
    Point<2> x;
    place >> x[0] >> x[1];
    return x;
  };
  EXPECT_LE(point_after(words).distance(Point<2>(body.turned(Point<2>(2, 0)))), 1e-9) << line;
  EXPECT_LE(point_after(meets).distance(Point<2>(body.turned(Point<2>(2.25, 0)))), 1e-9) << line;
  EXPECT_EQ(line.find("Friction"), std::string::npos) << line;
  scene = resting_block(3.9);
  scene.boundary("bottom").friction.bound = expression<2>(10.);
  EXPECT_NO_THROW(run(scene));
}

/** With the thickness the numbers are those of the body, as in tables, and only they. */
TEST_P(HeldByContact, ForcesInWordsAreThoseOfTheWholeThickness)
{
  Scene<2> sliding = pushed_block(2, 0.7, 0.6), lifting = resting_block(0, 1.25),
           toppling = resting_block(5);
  toppling.boundary("bottom").friction.bound = expression<2>(10.);
  for (Scene<2> *const scene : {&sliding, &lifting, &toppling})
    scene->thickness = 30;
  EXPECT_NE(failure_of(sliding).find("with 42, friction resists with 36;"), std::string::npos);
  EXPECT_NE(failure_of(lifting).find("the loads pull with 30, "), std::string::npos);
  EXPECT_NE(failure_of(toppling).find("the loads turn the body with 30 and meet"),
            std::string::npos);
  sliding = pushed_block(2, 0.59, 0.6);
  sliding.thickness = 30;
  EXPECT_NO_THROW(run(sliding));
}

// ---------------------------------------------------------------- several bodies

/** What differs from b, 2 x 1, that lies pressed by 2 on a, which is held; c may lie on it. */
struct Pile
{
  std::string name;
  Overrides entries;
  std::string words; ///< behind "no equilibrium: "
};

const Overrides c_on_b{
    {"Body c/Lower corner", "1, 2"},          {"Body c/Upper corner", "3, 3"},
    {"Boundary b.top/Pressure", ""},          {"Boundary c.top/Pressure", "1"},
    {"Contact k/Between", "c.bottom, b.top"}, {"Contact k/Friction coefficient", "0.3"}};

Scene<2> pile(const Overrides &first, const Overrides &second = {})
{
  Overrides entries{
      {"Body a/Upper corner", "4, 1"},           {"Body b/Lower corner", "1, 1"},
      {"Body b/Upper corner", "3, 2"},           {"Boundary a.bottom/Displacement", "0; 0"},
      {"Boundary b.top/Pressure", "1"},          {"Contact j/Between", "b.bottom, a.top"},
      {"Contact j/Friction coefficient", "0.3"}, {"Adaptivity/Maximum steps", "1"}};
  // An empty one takes away what it names, so that a body of another shape may have other sides.
  for (const Overrides *const more : {&first, &second})
    for (const auto &entry : *more)
    {
      entries.erase(std::remove_if(entries.begin(), entries.end(),
                                   [&](const auto &other) { return other.first == entry.first; }),
                    entries.end());
      if (!entry.second.empty())
        entries.push_back(entry);
    }
  return scene_of(entries);
}

TEST(Piles, GiveWayInTheWordsOfStatics)
{
  const std::string b_slides = "sliding along j: the loads push b with 0.8, friction resists with "
                               "0.3 * 2 = 0.6; add a support, raise Friction coefficient or lower "
                               "the loads",
                    change = "; add a support or change the loads";
  const auto on_b = [](Overrides more)
  {
    more.insert(more.begin(), c_on_b.begin(), c_on_b.end());
    return more;
  };
  const std::vector<Pile> piles{
      {"b slides", {{"Boundary b.left/Traction", "0.8; 0"}}, b_slides},
      {"to the left", {{"Boundary b.left/Traction", "-0.8; 0"}}, b_slides},
      {"told from below",
       {{"Boundary b.left/Traction", "0.8; 0"}, {"Contact j/Between", "a.top, b.bottom"}},
       b_slides},
      {"30 thick",
       {{"Boundary b.left/Traction", "0.8; 0"},
        {"Material/Plane", "stress"},
        {"Material/Thickness", "30"}},
       "sliding along j: the loads push b with 24, friction resists with 0.3 * 60 = 18; add a "
       "support, raise Friction coefficient or lower the loads"},
      {"without friction",
       {{"Boundary b.left/Traction", "0.8; 0"}, {"Contact j/Friction coefficient", ""}},
       "sliding along j: the loads push b with 0.8, nothing resists" + change},
      {"b lifts off",
       {{"Boundary b.top/Pressure", "-1"}},
       "lifting off j: the loads pull b with 2, contact can only press" + change},
      {"b topples",
       {{"Boundary b.left/Traction", "5; 0"}, {"Contact j/Friction coefficient", "5"}},
       "toppling about (3 1): the loads turn b with 0.5 and meet j at (3.25 1), beyond its end" +
           change},
      {"b topples, told from below",
       {{"Boundary b.left/Traction", "-5; 0"},
        {"Contact j/Between", "a.top, b.bottom"},
        {"Contact j/Friction coefficient", "5"}},
       "toppling about (1 1): the loads turn b with 0.5 and meet j at (0.75 1), beyond its end" +
           change},
      {"c slides on b",
       on_b({{"Boundary c.left/Traction", "0.8; 0"}, {"Contact j/Friction coefficient", "0.5"}}),
       "sliding along k: the loads push c with 0.8, friction resists with 0.3 * 2 = 0.6; add a "
       "support, raise Friction coefficient or lower the loads"},
      {"c takes b along",
       on_b({{"Boundary c.left/Traction", "0.5; 0"}, {"Contact j/Friction coefficient", "0.2"}}),
       "sliding along j: the loads push b and c with 0.5, friction resists with 0.2 * 2 = 0.4; add "
       "a support, raise Friction coefficient or lower the loads"},
      {"c is glued to b",
       on_b({{"Boundary b.left/Traction", "0.8; 0"},
             {"Contact k/Law", "tied"},
             {"Contact k/Friction coefficient", ""}}),
       "sliding along j: the loads push b and c with 0.8, friction resists with 0.3 * 2 = 0.6; add "
       "a support, raise Friction coefficient or lower the loads"},
      {"a slides on the floor",
       {{"Boundary b.left/Traction", "0.55; 0"},
        {"Boundary a.bottom/Displacement", ""},
        {"Boundary a.bottom/Contact", "unilateral"},
        {"Boundary a.bottom/Friction coefficient", "0.2"}},
       "sliding along a.bottom: the loads push a and b with 0.55, friction resists with 0.2 * 2 = "
       "0.4; add a support, raise Friction coefficient or lower the loads"},
      {"pulled out from between two",
       on_b({{"Boundary b.left/Traction", "1; 0"},
             {"Boundary c.top/Pressure", ""},
             {"Boundary c.top/Displacement", "0; 0"},
             {"Contact j/Friction coefficient", ""},
             {"Contact k/Friction coefficient", ""},
             {"Contact j/Friction bound", "0.1"},
             {"Contact k/Friction bound", "0.2"}}),
       "sliding along j and k: the loads push b with 1, friction resists with 0.6; add a support, "
       "raise Friction bound or lower the loads"},
      {"a disc in the place of a block",
       {{"Body b/Lower corner", ""},
        {"Body b/Upper corner", ""},
        given::half_disc("Body b", "2, 1.5", "0.5", "180"),
        {"Boundary b.top/Pressure", ""},
        {"Boundary b.flat/Pressure", "-1"},
        {"Contact j/Between", "b.arc, a.top"}},
       "lifting off: the loads push b along (0 1) with 1, contact can resist with 0 at most" +
           change}};
  for (const Pile &row : piles)
    EXPECT_EQ(failure_of(pile(row.entries)), "no equilibrium: " + row.words) << row.name;
}

/** What the words say is the limit: a little below it there is an equilibrium. */
TEST(Piles, StandBelowTheirLimits)
{
  EXPECT_NO_THROW(run(pile({{"Boundary b.left/Traction", "0.599; 0"}})));
  EXPECT_NO_THROW(run(pile(c_on_b, {{"Boundary c.left/Traction", "0.399; 0"},
                                    {"Contact j/Friction coefficient", "0.2"}})));
}

// ---------------------------------------------------------------- near the end of the foundation

/** A wall 1 x 2 of weight 2 on cells of degree @p degree, its resultant at @p x along its base. */
Scene<2> wall(const double x, const unsigned int columns, const unsigned int degree,
              const bool coulomb, const double angle = 0)
{
  const Turned body = rectangle(1, 2, angle);
  Scene<2> scene;
  scene.geometry = body.geometry(columns, columns);
  scene.materials = {material};
  scene.solver.normal_contact = NormalContact::multiplier;
  scene.adaptivity.start_degree = degree;
  scene.adaptivity.maximum_steps = 2;
  scene.body_force = body.field([](const Point<2> &) { return Point<2>(0, -1); });
  SymmetricTensor<2, 2> sigma;
  sigma[0][1] = x - 0.5; // times its height, over its weight
  scene.boundary(sides[2]).traction = body.traction(2, [=](const Point<2> &) { return sigma; });
  BoundaryCondition<2> &bottom = scene.boundary("bottom");
  bottom.contact = Contact::unilateral;
  (coulomb ? bottom.friction.coefficient : bottom.friction.bound) = expression<2>(0.6);
  return scene;
}

/** One cell of degree 2 has one Gauss point in the middle, and sees no turn about it. */
TEST(EccentricLoads, AreHeldUpToTheEndOfTheFoundation)
{
  struct Case
  {
    double x;
    unsigned int columns, degree;
    double angle;
  };
  for (const bool coulomb : {true, false})
    for (const Case &row : {Case{0.95, 2, 3, 0},
                            {0.05, 2, 3, 0},
                            {0.998, 2, 3, 0.3},
                            {0.9, 1, 2, 0},
                            {0.03, 1, 3, 0}})
    {
      SCOPED_TRACE(in_digits(row.x) + (coulomb ? " Coulomb" : " Tresca"));
      const Outcome last = run(wall(row.x, row.columns, row.degree, coulomb, row.angle));
      EXPECT_NEAR(last.contact.at(0).normal_resultant, -2, 1e-8);
      EXPECT_NEAR(std::abs(last.contact.at(0).friction_resultant), std::abs(row.x - 0.5), 1e-8);
      EXPECT_LE(last.equilibrium.moment_imbalance, 1e-8);
    }
}

/** No pressure of this mesh is at the end itself: what only that could hold is refused as such. */
TEST(EccentricLoads, AreRefusedWithTheirReasonBeyondTheLastPoint)
{
  for (const bool coulomb : {true, false})
  {
    const std::string inside = failure_of(wall(1 - 1e-6, 2, 3, coulomb)),
                      outside = failure_of(wall(1 + 1e-6, 2, 3, coulomb));
    EXPECT_EQ(inside.find("no equilibrium on this mesh: the loads turn the body about (0.9995"), 0U)
        << inside;
    EXPECT_NE(inside.find("it could near (1 0)"), std::string::npos) << inside;
    EXPECT_EQ(outside.find("no equilibrium: toppling about (1 0): the loads turn the body with "),
              0U)
        << outside;
    EXPECT_NE(outside.find("meet bottom at (1.000001 0)"), std::string::npos) << outside;
  }
}

/** Two pressures whose resultant is at x = 0.7 rub with a coefficient of 0.1 * 0.7 at most, not of 0.1. */
TEST(EccentricLoads, SlideByTheCoefficientWhereTheyPress)
{
  Scene<2> scene = wall(0.7, 2, 3, true);
  scene.boundary("bottom").friction.coefficient = expression<2>(
      std::function<double(const Point<2> &)>([](const Point<2> &x) { return 0.1 * x[0]; }));
  EXPECT_EQ(failure_of(scene),
            "no equilibrium: sliding along bottom: the loads push with 0.2, friction resists with "
            "0.07 * 2 = 0.14; add a support, raise Friction coefficient or lower the loads");
}

/** Friction near the middle of one half alone: no point of a coarse edge sees it, eighths of the edge do, and a bisected one holds. */
TEST(EccentricLoads, AreHeldByFrictionBetweenThePoints)
{
  Scene<2> scene = wall(0.625, 1, 2, true);
  scene.boundary("bottom").friction.coefficient =
      expression<2>(std::function<double(const Point<2> &)>(
          [](const Point<2> &x) { return std::abs(x[0] - 0.625) < 0.05 ? 0.5 : 0.; }));
  EXPECT_EQ(failure_of(scene), "");
}

/** A mesh that is fine enough stays as it is, and a run state knows the bisected one again. */
TEST(EccentricLoads, AreMetByBisectionOnlyWhereTheyMustBe)
{
  const auto cells = [](const Scene<2> &scene)
  {
    unsigned int n = 0;
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          if (step.number == 1)
            n = step.solution().displacement_space.degrees().size();
        });
    return n;
  };
  EXPECT_EQ(cells(wall(0.85, 2, 3, true)), 4U);
  EXPECT_EQ(cells(wall(0.9, 2, 3, true)), 7U); // one bisection
  const Scene<2> scene = wall(0.95, 2, 3, true);
  AdaptiveSolver<2> solver(scene);
  std::optional<RunState<2>> state;
  std::vector<double> energies;
  solver.run(
      [&](const StepReport<2> &step)
      {
        if (step.number == 1)
          state.emplace(solver.state());
        energies.push_back(step.energies.energy);
      });
  AdaptiveSolver<2>(scene, *state)
      .run([&](const StepReport<2> &step) { EXPECT_EQ(step.energies.energy, energies.back()); });
}

// ---------------------------------------------------------------- statics

/** The resultant of the contact passes through the point where that of the loads meets the plane. */
TEST_P(HeldByContact, ContactBalancesWeightAndPush)
{
  for (const double push : {0., 1., 2., -2.})
  {
    Scene<2> scene = resting_block(push);
    scene.adaptivity.maximum_steps = 6;
    const Outcome last = run(scene);
    EXPECT_LE(last.equilibrium.force_imbalance, 1e-8);
    EXPECT_LE(last.equilibrium.moment_imbalance, 1e-8);
    const ContactState<2> &state = last.contact.at(0);
    EXPECT_NEAR(state.normal_resultant, -4, 1e-8);
    EXPECT_NEAR(state.friction_resultant, -push, 1e-8);
    ASSERT_EQ(last.equilibrium.reactions.size(), 1u);
    EXPECT_NEAR(last.equilibrium.reactions[0].moment, 0.,
                1e-8); // weight and push act in the centre
  }
}

// ---------------------------------------------------------------- the way there

void expect_same(const Outcome &one, const Outcome &other, const double tolerance)
{
  ASSERT_EQ(one.u.size(), other.u.size());
  ASSERT_EQ(one.z.size(), other.z.size());
  Vector<double> u = one.u, z = one.z;
  u -= other.u;
  z -= other.z;
  EXPECT_LE(u.linfty_norm(), tolerance * one.u.linfty_norm());
  EXPECT_LE(z.linfty_norm(), tolerance * one.z.linfty_norm());
}

TEST_P(HeldByContact, StartsAndSolversLeadToOneSolution)
{
  Scene<2> scene = resting_block(2);
  scene.adaptivity.maximum_steps = 6;
  const Outcome warm = run(scene);
  scene.solver.qp_warm_start = false;
  expect_same(warm, run(scene), 1e-9);
  scene.solver.qp_solver = QpSolver::mprgp;
  expect_same(warm, run(scene), 1e-9);
  scene.solver.qp_warm_start = true;
  expect_same(warm, run(scene), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(, HeldByContact,
                         ::testing::Combine(::testing::ValuesIn(both_discretisations),
                                            ::testing::Values(0., numbers::PI / 6)),
                         [](const auto &info) {
                           return name_of(std::get<0>(info.param)) +
                                  (std::get<1>(info.param) == 0. ? "" : "Turned");
                         });

/** Turned by 30 degrees the block has the same tractions and energy. */
TEST(HeldByContactTurned, DoesNotDependOnTheAxes)
{
  for (const std::string normal : {"nodes", "multiplier"})
  {
    const Overrides few = {{"Adaptivity/Method", "hap3"}, // no decay rates of components
                           {"Adaptivity/Maximum steps", "4"},
                           {"Solver/Normal contact", normal}};
    const double c = std::cos(numbers::PI / 6), s = std::sin(numbers::PI / 6);
    const auto vector = [&](const double x, const double y, const std::string &separator)
    { return in_digits(c * x - s * y) + separator + in_digits(s * x + c * y); };
    const Overrides turned =
        few + Overrides{given::quadrilateral("Geometry",
                                             vector(0, 0, ", ") + "; " + vector(2, 0, ", ") + "; " +
                                                 vector(2, 2, ", ") + "; " + vector(0, 2, ", ")),
                        {"Body force/Expression", vector(0, -1, "; ")},
                        {"Boundary left/Traction", vector(1, 0, "; ")}};
    const Outcome one = run(shipped_scene("resting", few)),
                  other = run(shipped_scene("resting", turned));
    ASSERT_EQ(one.z.size(), other.z.size());
    EXPECT_NEAR(one.norm, other.norm, 1e-10 * one.norm);
    for (unsigned int i = 0; i < one.z.size(); ++i)
      EXPECT_NEAR(one.z[i], other.z[i], 1e-8);
  }
}
/** A block that locks loses digits to its factorisation: the motion that corrections bring about puts it on its plane again. */
TEST(CorrectedBody, StaysOnItsPlane)
{
  unsigned int n_corrected = 0;
  for (const std::string normal : {"nodes", "multiplier"})
    each_step<2>(shipped_scene("resting", {{"Material/Poisson's ratio", "0.4999"},
                                           {"Solver/Normal contact", normal},
                                           {"Adaptivity/Method", "hup2"},
                                           {"Adaptivity/Maximum unknowns", "4000"},
                                           {"Error/Bound", "false"}}),
                 [&](const StepReport<2> &step)
                 {
                   n_corrected += step.reduced->algebraic.corrections > 0;
                   expect_complementary(step.solution());
                 });
  EXPECT_GE(n_corrected, 4u);
}
} // namespace
