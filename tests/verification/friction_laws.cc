// SPDX-License-Identifier: LGPL-2.1-or-later
// What the laws of friction allow, and the two that take a bound and a coefficient.
#include "coulomb_law.h"

#include <hpvi/driver/load_history.h>

#include <limits>
#include <map>

namespace
{
using namespace verification;

FrictionLaw<2> law(const double g, const double mu, const FrictionForm form)
{
  return {expression<2>(g), expression<2>(mu), form};
}

/** Each law at a pressure below zero, at zero, and on both sides of the kink. */
TEST(FrictionLaw, HasItsLimitAndItsSlope)
{
  struct Value
  {
    double p, limit, slope;
  };
  struct Case
  {
    FrictionLaw<2> law;
    bool knows_pressure;
    std::string name;
    std::vector<Value> values;
  };
  const Expression<2> g = expression<2>([](const Point<2> &x) { return x[0]; }),
                      mu = expression<2>([](const Point<2> &x) { return x[1]; });
  const std::vector<Case> cases = {
      {{g, nullptr}, false, "Tresca's law", {{-1, 0.5, 0}, {0, 0.5, 0}, {7, 0.5, 0}}},
      {{nullptr, mu}, true, "Coulomb's law", {{-1, 0, 0}, {0, 0, 0}, {7, 1.75, 0.25}}},
      {{g, mu, FrictionForm::limited},
       true,
       "limited Coulomb friction",
       {{-1, 0, 0}, {1, 0.25, 0.25}, {2, 0.5, 0.25}, {7, 0.5, 0}}},
      {{g, mu, FrictionForm::cohesive},
       true,
       "cohesive Coulomb friction",
       {{-1, 0.5, 0}, {0, 0.5, 0}, {2, 1, 0.25}}}};
  const Point<2> x(0.5, 0.25);
  for (const Case &one : cases)
  {
    SCOPED_TRACE(one.name);
    EXPECT_TRUE(one.law);
    EXPECT_EQ(one.law.knows_pressure(), one.knows_pressure);
    EXPECT_EQ(one.law.name(), one.name);
    EXPECT_FALSE(one.law.problem({x}));
    EXPECT_FALSE(one.law.at(x).vanishes());
    EXPECT_TRUE(one.law.at(Point<2>()).vanishes());
    for (const auto &[p, limit, slope] : one.values)
    {
      EXPECT_EQ(one.law.limit(x, p), limit) << p;
      EXPECT_EQ(one.law.slope(x, p), slope) << p;
    }
  }
  EXPECT_FALSE(FrictionLaw<2>());
  EXPECT_EQ(FrictionLaw<2>().limit(x, 1.), 0.);
}

FrictionLaw<2> by_pressure(const std::function<double(double)> &mu)
{
  FrictionLaw<2> result{nullptr, expression<2>(mu(0.))};
  result.by_pressure = std::make_shared<const std::function<double(const Point<2> &, double)>>(
      [mu](const Point<2> &, const double p) { return mu(p); });
  return result;
}

double falling(const double p)
{
  return 0.5 / (1. + p);
}

/** By itself, below a bound and above one; (mu p)' = 0.5/(1 + p)^2, from differences over 1e-4 p. */
TEST(FrictionByPressure, HasItsLimitAndItsSlope)
{
  const Point<2> x;
  FrictionLaw<2> law = by_pressure(falling);
  EXPECT_TRUE(law.knows_pressure());
  EXPECT_FALSE(law.is_proportional());
  EXPECT_FALSE(law.problem({x}));
  for (const double p : {1e-12, 1e-3, 1., 1e3})
  {
    EXPECT_NEAR(law.limit(x, p), falling(p) * p, 1e-15 * p);
    EXPECT_NEAR(law.slope(x, p), 0.5 / std::pow(1. + p, 2), 1e-8);
    const FrictionLimit::Piece tangent = law.at(x).piece(p);
    EXPECT_NEAR(tangent.at_zero + tangent.slope * p, law.limit(x, p), 1e-15);
  }
  EXPECT_EQ(law.limit(x, 0.), 0.);
  EXPECT_EQ(law.limit(x, -1.), 0.);
  EXPECT_EQ(law.slope(x, -1.), 0.);
  EXPECT_EQ(law.at(x).continued(-1.), -0.5);
  EXPECT_FALSE(law.everywhere().by_pressure);
  law.bound = expression<2>(0.3);
  law.form = FrictionForm::limited;
  EXPECT_EQ(law.limit(x, 1.), 0.25);
  EXPECT_EQ(law.limit(x, 9.), 0.3);
  EXPECT_EQ(law.slope(x, 9.), 0.);
  law.form = FrictionForm::cohesive;
  EXPECT_EQ(law.limit(x, 1.), 0.55);
  EXPECT_EQ(law.limit(x, -1.), 0.3);
}

/** What falls or bends upwards is told from what grows and is concave, up to the pressure that is asked. */
TEST(FrictionByPressure, IsRefusedWhereItFallsOrBendsUpwards)
{
  struct Case
  {
    std::function<double(double)> mu;
    double largest;
    std::string words; ///< none: sound
  };
  const auto linear = [](const double p) { return 0.5 - 0.001 * p; };
  const auto step = [](const double to)
  { return [to](const double p) { return p < 3 ? 0.3 : to; }; };
  for (const Case &one : {Case{falling, 1e6, ""}, Case{linear, 250, ""},
                          Case{linear, 270, "lets friction mu_f p fall from"},
                          Case{[](const double p) { return 0.3 / std::max(p, 0.1); }, 1e4, ""},
                          Case{[](const double p) { return std::pow(p + 1e-9, -1. / 3); }, 50, ""},
                          Case{[](const double p) { return 0.1 + 1e-6 * p; }, 10, "bend upwards"},
                          Case{step(0.1), 2.9, ""}, Case{step(0.1), 4, "fall from 0.8625 to 0.3"},
                          Case{step(0.29), 100, "bend upwards from p = 3.125"}})
  {
    const auto problem = by_pressure(one.mu).problem(Point<2>(), one.largest);
    EXPECT_EQ(bool(problem), !one.words.empty()) << one.largest << (problem ? problem->words : "");
    const std::string words = problem ? problem->words : "";
    EXPECT_NE(words.find(one.words), std::string::npos) << words;
  }
}

/** Functions without the law, and the law without them. */
TEST(FrictionLaw, IsRefusedWhereItContradictsItself)
{
  const std::vector<Point<2>> x(1);
  EXPECT_EQ(law(1, 1, FrictionForm::automatic).problem(x)->entry, "Friction coefficient");
  EXPECT_EQ(law(-1, 1, FrictionForm::limited).problem(x)->entry, "Friction bound");
  EXPECT_EQ(law(1, -1, FrictionForm::cohesive).problem(x)->entry, "Friction coefficient");
  for (const FrictionForm form : {FrictionForm::limited, FrictionForm::cohesive})
    EXPECT_EQ((FrictionLaw<2>{expression<2>(1.), nullptr, form}.problem(x)->entry), "Friction law");
}

// ---------------------------------------------------------------- uniform and linear stresses

struct Patch
{
  std::string name;
  FrictionLaw<2> friction;
  double limit; ///< wherever the boundary slips
};

using FrictionPatch = ::testing::TestWithParam<std::tuple<Patch, CoulombMethod, Contact>>;

/**
 * sigma_yy = -(1 + x), sigma_xy = tau: with E = 1 and nu = 0 that is u = (2 tau y + y^2/2 + slip, -(1 + x) y), and
 * the limit is tau along the whole boundary, by one part of the law on its left half and by the other on its
 * right. Sheared by less it sticks.
 */
TEST_P(FrictionPatch, SlipsByBothPartsOfTheLaw)
{
  const auto &[patch, method, contact] = GetParam();
  for (const bool slips : {true, false})
  {
    const double tau = slips ? patch.limit : 0.8 * patch.limit, slip = slips ? 0.07 : 0.;
    Scene<2> scene;
    scene.geometry.corners = box_corners<2>({0, 0}, {2, 1});
    scene.geometry.subdivisions = {{2, 1}};
    scene.materials = {{1, 0, PlaneModel::strain}};
    prescribe(scene, [tau = tau, slip = slip](const Point<2> &x)
              { return Point<2>(2 * tau * x[1] + x[1] * x[1] / 2 + slip, -(1 + x[0]) * x[1]); });
    for (const std::string side : {"left", "right"}) // they slide along with the bottom
      scene.boundary(side).displacement = {};
    scene.boundary("left").traction[1] = expression<2>(-tau);
    scene.boundary("right").traction[1] = expression<2>(tau);
    BoundaryCondition<2> &bottom = scene.boundary("bottom");
    bottom.contact = contact;
    bottom.friction = patch.friction;
    scene.solver.coulomb_method = method;
    scene.adaptivity.maximum_steps = 2;
    const Outcome outcome = run(scene);
    for (const ContactPoint<2> &point : outcome.contact.points)
    {
      EXPECT_NEAR(point.normal_traction, -(1 + point.x[0]), 1e-10);
      EXPECT_NEAR(point.tangential_traction, -tau, 1e-10);
      EXPECT_NEAR(point.tangential_displacement, slip, 1e-10);
      EXPECT_EQ(point.mode(), slips ? ContactMode::slip : ContactMode::stick);
    }
    EXPECT_NEAR(outcome.contact.friction_resultant, -2 * tau, 1e-10);
  }
}

Expression<2> halves(const std::function<double(const Point<2> &)> &left,
                     const std::function<double(const Point<2> &)> &right)
{
  return expression<2>([=](const Point<2> &x) { return x[0] < 1 ? left(x) : right(x); });
}

INSTANTIATE_TEST_SUITE_P(
    , FrictionPatch,
    ::testing::Combine(
        ::testing::Values(
            // 0.3/p below a bound of 1, then the bound 0.3 below 0.2 p
            Patch{"limited",
                  {halves([](const auto &) { return 1.; }, [](const auto &) { return 0.3; }),
                   halves([](const auto &x) { return 0.3 / (1 + x[0]); },
                          [](const auto &) { return 0.2; }),
                   FrictionForm::limited},
                  0.3},
            // 0.3 under every pressure
            Patch{"by_pressure", by_pressure([](const double p) { return 0.3 / std::max(p, 0.5); }),
                  0.3},
            // 0.1 + (0.2/p) p, then 0.3 alone
            Patch{"cohesive",
                  {halves([](const auto &) { return 0.1; }, [](const auto &) { return 0.3; }),
                   halves([](const auto &x) { return 0.2 / (1 + x[0]); },
                          [](const auto &) { return 0.; }),
                   FrictionForm::cohesive},
                  0.3}),
        ::testing::Values(CoulombMethod::newton, CoulombMethod::fixed_point),
        ::testing::Values(Contact::unilateral, Contact::bilateral)),
    [](const auto &info)
    {
      return std::get<0>(info.param).name +
             (std::get<1>(info.param) == CoulombMethod::newton ? "_newton" : "_fixed_point") +
             (std::get<2>(info.param) == Contact::unilateral ? "_unilateral" : "_bilateral");
    });

/** What pulls rubs by its cohesion alone, and not at all where friction is limited. */
TEST(FrictionLaws, UnderTension)
{
  for (const FrictionForm form : {FrictionForm::limited, FrictionForm::cohesive})
  {
    const double tau = form == FrictionForm::cohesive ? 0.1 : 0.;
    Scene<2> scene;
    scene.geometry.corners = box_corners<2>({0, 0}, {2, 1});
    scene.materials = {{1, 0, PlaneModel::strain}};
    scene.boundary("bottom").contact = Contact::bilateral;
    scene.boundary("bottom").friction = law(0.1, 0.4, form);
    scene.boundary("top").displacement = {{expression<2>(2 * tau + 0.07), expression<2>(1.)}};
    scene.boundary("left").traction[1] = expression<2>(-tau);
    scene.boundary("right").traction[1] = expression<2>(tau);
    scene.adaptivity.maximum_steps = 1;
    for (const ContactPoint<2> &point : run(scene).contact.points)
    {
      EXPECT_NEAR(point.tangential_traction, -tau, 1e-12);
      EXPECT_NEAR(point.tangential_displacement, 0.07, 1e-12);
    }
  }
}

// ---------------------------------------------------------------- a body with both regimes

/** A block pressed and sheared by its top, to the right less and more: stick, slip at the bound, slip with the pressure. */
Scene<2> pushed_block(const FrictionLaw<2> &friction)
{
  Scene<2> scene;
  scene.geometry.corners = box_corners<2>({0, 0}, {4, 1});
  scene.geometry.subdivisions = {{8, 2}};
  scene.materials = {{1000, 0.3, PlaneModel::strain}};
  scene.boundary("bottom").contact = Contact::unilateral;
  scene.boundary("bottom").friction = friction;
  scene.boundary("top").displacement = {
      {expression<2>([](const Point<2> &x) { return 0.0011 * x[0]; }),
       expression<2>([](const Point<2> &x) { return -0.006 + 0.0013 * x[0]; })}};
  scene.adaptivity.maximum_steps = 4;
  scene.error_bound = false;
  return scene;
}

Vector<double> last_multiplier(const Scene<2> &scene)
{
  Vector<double> z;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        if (scene.has_coulomb_friction())
          expect_coulomb(step.solution());
        EXPECT_LE(step.equilibrium.force_imbalance, 1e-8);
        EXPECT_EQ(step.bound, std::nullopt);
        z = step.solution().z;
      });
  return z;
}

TEST(FrictionLaws, HoldAtTheirPointsInEveryRegime)
{
  for (const FrictionForm form : {FrictionForm::limited, FrictionForm::cohesive})
  {
    unsigned int with_pressure = 0, at_bound = 0, stick = 0;
    const Scene<2> scene = pushed_block(law(0.5, 0.3, form));
    double friction = 0, force = 0;
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          expect_coulomb(step.solution());
          EXPECT_LE(step.equilibrium.force_imbalance, 1e-8);
          for (const ContactPoint<2> &point : step.contact.at(0).points)
          {
            const double p = std::max(0., -point.normal_traction);
            const bool is_limited = form == FrictionForm::limited;
            EXPECT_NEAR(point.friction_bound, is_limited ? std::min(0.3 * p, 0.5) : 0.5 + 0.3 * p,
                        1e-10);
            ++(point.mode() == ContactMode::stick ? stick
               : is_limited                       ? (0.3 * p < 0.5 ? with_pressure : at_bound)
                                                  : (p > 0. ? with_pressure : at_bound));
          }
          friction = step.contact.at(0).friction_resultant;
          for (const auto &resultant : step.equilibrium.reactions)
            if (resultant.boundary == "top")
              force = resultant.force[0];
        });
    EXPECT_GT(std::min({with_pressure, stick}), 0U);
    EXPECT_TRUE(form == FrictionForm::cohesive || at_bound > 0U);
    EXPECT_NEAR(friction + force, 0., 1e-8 * std::abs(force));
  }
}

/** mu_f = 0.5/(1 + p): against Coulomb's law with the coefficients that the pressures of the problem before give. */
TEST(FrictionByPressure, IsWhereTheIterationOverItsCoefficientsEnds)
{
  const auto pushed_softly = [](const FrictionLaw<2> &friction)
  {
    Scene<2> scene = pushed_block(friction);
    scene.materials[0].young = 100; // pressures around 0.5, where 0.5/(1 + p) bends
    scene.adaptivity.maximum_steps = 1;
    return scene;
  };
  const Scene<2> scene = pushed_softly(by_pressure(falling));
  const auto state = [](const Scene<2> &of, unsigned int &slips)
  {
    std::map<double, double> pressures; // by place
    Vector<double> z;
    AdaptiveSolver<2>(of).run(
        [&](const StepReport<2> &step)
        {
          expect_coulomb(step.solution());
          z = step.solution().z;
          slips = 0;
          for (const ContactPoint<2> &point : step.contact.at(0).points)
          {
            pressures[point.x[0]] = std::max(0., -point.normal_traction);
            slips += point.mode() == ContactMode::slip;
          }
        });
    return std::pair{z, pressures};
  };
  unsigned int slips = 0;
  const auto [z, pressures] = state(scene, slips);
  EXPECT_GT(slips, 2U);
  EXPECT_LT(slips, pressures.size() - 2);
  Scene<2> frozen = pushed_softly({nullptr, expression<2>(0.5)});
  Vector<double> last;
  double change = 1;
  for (unsigned int k = 0; k < 40 && change > 1e-13; ++k)
  {
    const auto [next, known] = state(frozen, slips);
    if (last.size() > 0)
    {
      last -= next;
      change = last.linfty_norm() / next.linfty_norm();
    }
    last = next;
    frozen.boundary("bottom").friction.coefficient = expression<2>( // straight between the points
        [known = known](const Point<2> &x)
        {
          const auto right = known.lower_bound(x[0]);
          if (right == known.begin() || right == known.end())
            return falling(right == known.begin() ? right->second : known.rbegin()->second);
          const auto left = std::prev(right);
          const double s = (x[0] - left->first) / (right->first - left->first);
          return (1 - s) * falling(left->second) + s * falling(right->second);
        });
  }
  EXPECT_LE(change, 1e-13);
  last -= z;
  EXPECT_LE(last.linfty_norm(), 1e-9 * z.linfty_norm());
}

/** Where one part of a law says nothing, the other is Coulomb's or Tresca's. */
TEST(FrictionLaws, HaveTheLimitsThatTheyShould)
{
  const auto agree = [](const Scene<2> &one, const Scene<2> &other, const double tolerance)
  {
    const Vector<double> z = last_multiplier(one), expected = last_multiplier(other);
    ASSERT_EQ(z.size(), expected.size());
    for (unsigned int i = 0; i < z.size(); ++i)
      EXPECT_NEAR(z[i], expected[i], tolerance * expected.linfty_norm());
  };
  const Scene<2> coulomb = pushed_block({nullptr, expression<2>(0.3)});
  agree(pushed_block(law(1e30, 0.3, FrictionForm::limited)), coulomb, 0.);
  agree(pushed_block(law(0, 0.3, FrictionForm::cohesive)), coulomb, 0.);
  Scene<2> tresca = pushed_block({expression<2>(0.5), nullptr});
  tresca.solver.normal_contact = NormalContact::multiplier;
  tresca.adaptivity.maximum_steps =
      1; // the indicator of a law that knows the pressure has one part more
  for (const double mu : {0., 1e-12})
  {
    Scene<2> cohesive = pushed_block(law(0.5, mu, FrictionForm::cohesive));
    cohesive.adaptivity.maximum_steps = 1;
    agree(cohesive, tresca, 1e-9);
  }
}

TEST(FrictionLaws, HaveOneSolutionByBothSolvers)
{
  for (const FrictionLaw<2> &friction :
       {law(0.5, 0.3, FrictionForm::limited), law(0.5, 0.3, FrictionForm::cohesive),
        by_pressure(falling)})
  {
    Scene<2> scene = pushed_block(friction);
    const Vector<double> newton = last_multiplier(scene);
    scene.solver.coulomb_method = CoulombMethod::fixed_point;
    const Vector<double> fixed_point = last_multiplier(scene);
    ASSERT_EQ(newton.size(), fixed_point.size());
    for (unsigned int i = 0; i < newton.size(); ++i)
      EXPECT_NEAR(newton[i], fixed_point[i], 1e-8 * newton.linfty_norm());
  }
}

/** The punch sticks, slips by the pressure, and at the bound next to its edge, where the pressure has none. */
TEST(FrictionLaws, LimitTheShippedPunch)
{
  const ContactState<2> punch =
      run(shipped_scene("punch-limited", {{"Adaptivity/Maximum steps", "8"}})).contact;
  ASSERT_EQ(punch.zones.size(), 3u);
  EXPECT_EQ(punch.zones[0].mode, ContactMode::stick);
  EXPECT_EQ(punch.zones[1].mode, ContactMode::slip);
  EXPECT_EQ(punch.zones[2].mode, ContactMode::open);
  double reached = 0, first = 2;
  for (const ContactPoint<2> &point : punch.points)
  {
    EXPECT_LE(std::abs(point.tangential_traction), 0.8 * (1 + 1e-12));
    reached = std::max(reached, -0.15 * point.normal_traction);
    if (point.mode() == ContactMode::slip && point.friction_bound < 0.79)
      first = std::min(first, point.x[0]);
  }
  EXPECT_GT(reached, 1.6); // twice the bound
  EXPECT_LT(first, 0.8);   // and some slip below it
}

// ---------------------------------------------------------------- statics, histories, what an edge misses

/** A free block 3 x 0.5 of weight 1.5 moves at min(mu N, g L) or g L + mu N. */
TEST(FrictionLaws, HoldABlockUpToTheirForce)
{
  struct Case
  {
    FrictionLaw<2> friction;
    double limit;
    std::string words;
  };
  for (const Case &one :
       {Case{law(0.06, 5, FrictionForm::limited), 0.18, "friction resists with 0.18; "},
        Case{law(9, 0.1, FrictionForm::limited), 0.15, "friction resists with 0.1 * 1.5 = 0.15; "},
        Case{law(0.06, 0.1, FrictionForm::cohesive), 0.33,
             "friction resists with 0.1 * 1.5 + 0.18 = 0.33; "}})
  {
    const auto scene = [&](const double push)
    {
      Scene<2> scene;
      scene.geometry.corners = box_corners<2>({0, 0}, {3, 0.5});
      scene.geometry.subdivisions = {{4, 1}};
      scene.materials = {{1000, 0.3, PlaneModel::strain}};
      scene.body_force = {{expression<2>(push / 1.5), expression<2>(-1.)}};
      scene.boundary("bottom").contact = Contact::unilateral;
      scene.boundary("bottom").friction = one.friction;
      scene.adaptivity.maximum_steps = 2;
      return scene;
    };
    EXPECT_NEAR(run(scene(0.99 * one.limit)).contact.friction_resultant, -0.99 * one.limit, 1e-9);
    EXPECT_EQ(failure_of(scene((1 - 1e-6) * one.limit)), "") << one.words;
    const std::string failure = failure_of(scene((1 + 1e-6) * one.limit));
    EXPECT_EQ(failure.find("no equilibrium: sliding along bottom: "), 0U) << failure;
    EXPECT_NE(failure.find(one.words), std::string::npos) << failure;
    EXPECT_NE(failure.find("raise Friction bound and Friction coefficient"), std::string::npos)
        << failure;
  }
}

/** A block moved to and fro: friction obeys its law in each load step and takes energy. */
TEST(FrictionLaws, TakeLoadHistories)
{
  for (const std::string law : {"limited", "cohesive"})
  {
    double dissipated = 0;
    LoadHistory<2>(scene_of({given::box("4, 1", "4, 1"),
                             {"Material/Young's modulus", "1000"},
                             {"Loading/Steps", "4"},
                             {"Boundary top/Displacement", "0.008*sin(2*pi*t); -0.004"},
                             given::rough("bottom", "unilateral", "0.8"),
                             {"Boundary bottom/Friction coefficient", "0.3"},
                             {"Boundary bottom/Friction law", law},
                             {"Adaptivity/Maximum steps", "1"}}))
        .run(
            [&](const StepReport<2> &step)
            {
              expect_coulomb(step.solution());
              EXPECT_GE(step.load.dissipated, dissipated);
              dissipated = step.load.dissipated;
            });
    EXPECT_GT(dissipated, 0.);
  }
}

/** The limit bends inside one edge, p = 3, at its points 1/2 -+ 1/sqrt(12): p = 1, mu_f = x, g = 1/2. */
TEST(FrictionLaws, NameWhatAnEdgeMisses)
{
  Scene<2> scene = scene_of({{"Boundary top/Displacement", "0; 0"},
                             given::rough("bottom", "unilateral", "0.5"),
                             {"Boundary bottom/Friction coefficient", "x"},
                             {"Boundary bottom/Friction law", "limited"}});
  const auto bounds = PressedEdge(scene).bounds(1.);
  ASSERT_EQ(bounds.size(), 1U);
  EXPECT_EQ(bounds[0].entry, "Friction law");
  EXPECT_NEAR(bounds[0].sum, 0.5 * (0.5 - 1 / std::sqrt(12.)) + 0.25, 1e-14);
  EXPECT_NEAR(bounds[0].integral, 0.375, 0.02); // of one Gauss rule over the kink
  scene.boundary("bottom").friction.form = FrictionForm::cohesive;
  EXPECT_TRUE(PressedEdge(scene).bounds(1.).empty());
}

/** A jump of the bound matters where it is the limit, one of the coefficient where that is. */
TEST(FrictionLaws, CountJumpsWhereTheyAct)
{
  for (const bool capped : {true, false})
  {
    Scene<2> scene = scene_of({{"Boundary top/Displacement", "0; 0"},
                               given::rough("bottom", "unilateral", "if(x < 0.4, 0.5, 0.6)"),
                               {"Boundary bottom/Friction coefficient", "if(x < 0.4, 0.3, 0.4)"},
                               {"Boundary bottom/Friction law", "limited"}});
    PressedEdge edge(scene);
    const auto jumps = edge.space.unresolved_jumps(edge.under(capped ? 10. : 1.));
    ASSERT_EQ(jumps.size(), 1U);
    EXPECT_EQ(jumps[0].entry, capped ? "Friction bound" : "Friction coefficient");
    EXPECT_NEAR(jumps[0].height, 0.1, 1e-12);
    EXPECT_NEAR(jumps[0].force, 0.1, 1e-12);
  }
}
} // namespace
