// SPDX-License-Identifier: LGPL-2.1-or-later
// What happens on the contact boundary: one rule for the friction bound, states and transitions,
// tractions that act there besides the contact.
#include "friction_quadrature.h"

#include <deal.II/numerics/vector_tools_interpolate.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/results/contact_state.h>
#include <hpvi/results/contact_traces.h>
#include <hpvi/results/solution_field.h>

#include <algorithm>

namespace
{
using namespace verification;

// ---------------------------------------------------------------- the rule of one edge

FrictionRule rule_of(const std::function<double(double)> &g, const unsigned int p)
{
  return make_friction_rule(g, QGauss<1>(p + 1), 2 * p - 2);
}

/** int g s^k by the rule. */
double moment(const FrictionRule &rule, const unsigned int k)
{
  double sum = 0;
  for (unsigned int q = 0; q < rule.points.size(); ++q)
    sum += rule.weights[q] * rule.values[q] * std::pow(rule.points[q], k);
  return sum;
}

TEST(FrictionRule, TakesGaussPointsOfTheWholeEdgeForACubic)
{
  for (unsigned int p = 2; p <= 12; ++p)
  {
    const FrictionRule rule = rule_of([](const double s) { return 1 + s - 2 * s * s * s; }, p);
    const QGauss<1> gauss(p + 1);
    ASSERT_EQ(rule.points.size(), p + 1) << "p = " << p;
    EXPECT_EQ(rule.cuts, (std::vector<double>{0., 1.}));
    for (unsigned int q = 0; q <= p; ++q)
    {
      EXPECT_EQ(rule.points[q], gauss.point(q)[0]);
      EXPECT_EQ(rule.weights[q], gauss.weight(q));
    }
    EXPECT_NEAR(rule.integral(), 1., 1e-14);
  }
}

TEST(FrictionRule, CutsAtJumps)
{
  for (unsigned int p = 2; p <= 12; ++p)
    for (const double a : {0.05, 0.25, 1. / 3., 0.5, 0.75, 0.9})
    {
      const FrictionRule rule = rule_of([a](const double s) { return s < a ? 1. : 4.5; }, p);
      ASSERT_EQ(rule.jumps.size(), 1U) << "p = " << p << ", jump at " << a;
      EXPECT_NEAR(rule.jumps[0].s, a, 1e-15);
      EXPECT_EQ(rule.jumps[0].height, 3.5);
      EXPECT_EQ(rule.cuts.size(), 3U);
      for (unsigned int k = 0; k <= 2 * p - 2; ++k)
        EXPECT_NEAR(moment(rule, k), (4.5 - 3.5 * std::pow(a, k + 1)) / (k + 1), 1e-13);
    }
}

/** Wherever it lies; it is never mistaken for no friction. */
TEST(FrictionRule, FindsABumpOfAFortiethOfTheEdge)
{
  for (const double width : {0.1, 0.025})
    for (unsigned int p = 2; p <= 12; ++p)
      for (double a = 0; a < 0.975 - width; a += 0.0037) // what is left behind it is no narrower
      {
        const FrictionRule rule =
            rule_of([=](const double s) { return a < s && s < a + width ? 2. : 0.; }, p);
        EXPECT_FALSE(rule.vanishes()) << "p = " << p << ", bump at " << a;
        EXPECT_NEAR(rule.integral(), 2 * width, 1e-13) << "p = " << p << ", bump at " << a;
      }
}

TEST(FrictionRule, ResolvesKinksAndRootsWithoutCallingThemJumps)
{
  const FrictionRule kink = rule_of([](const double s) { return std::abs(s - 0.3); }, 4);
  EXPECT_NEAR(kink.integral(), 0.29, 1e-13);
  const FrictionRule root = rule_of([](const double s) { return std::sqrt(s); }, 4);
  EXPECT_NEAR(root.integral(), 2. / 3., 1e-12);
  const FrictionRule steep = rule_of([](const double s) { return std::exp(-40 * s); }, 4);
  EXPECT_NEAR(steep.integral(), (1 - std::exp(-40)) / 40, 1e-12);
  for (const FrictionRule &rule : {kink, root, steep})
    EXPECT_TRUE(rule.jumps.empty());
}

TEST(FrictionRule, GivesUpOnNoise)
{
  const FrictionRule rule = rule_of([](const double s) { return 1 + std::sin(1e6 * s * s); }, 3);
  EXPECT_EQ(rule.cuts.size(), 65U);
  EXPECT_NEAR(rule.integral(), 1., 0.3);
}

// ---------------------------------------------------------------- one rule for all integrals

/** A block that is pushed along a plane; g is to be added. */
const Overrides pushed = {given::box("3, 1", "3, 1"),
                          {"Boundary left/Traction", "1.5; -0.2*y"},
                          {"Boundary top/Traction", "0.4; -0.1*x"},
                          {"Boundary right/Displacement", "0; 0"},
                          {"Boundary bottom/Contact", "bilateral"},
                          given::steps("hpa3", "6"),
                          {"Material/Young's modulus", "1"},
                          {"Units/Length", "1"},
                          {"Units/Stress", "1"}};

Scene<2> pushed_with(const std::string &bound, const Overrides &more = {})
{
  return scene_of(with(with(pushed, {{"Boundary bottom/Friction bound", bound}}), more));
}

/** Kept in tests beside g itself: int g over the contact boundary. */
struct Bound
{
  std::string g;
  double integral;
};

using AnyBound = ::testing::TestWithParam<Bound>;

/** b(u, z) of the Lagrangian is z' B u where L = -a/2 holds; J integrates g itself. */
TEST_P(AnyBound, IsIntegratedInTheEnergies)
{
  each_step<2>(
      pushed_with(GetParam().g),
      [&](const StepReport<2> &step)
      {
        SCOPED_TRACE("step " + std::to_string(step.number));
        const Energies &e = step.energies;
        const double a = e.norm * e.norm;
        EXPECT_NEAR(step.solution().contact_space.friction_limit(), GetParam().integral, 1e-11);
        EXPECT_NEAR(e.lagrangian, -0.5 * a, 1e-10 * a);
        const FrictionIntegrals sums = integrate_friction(step.solution(), 4096);
        EXPECT_NEAR(step.contact.at(0).friction_resultant, sums.resultant, 1e-6 * sums.bound);
        EXPECT_NEAR(e.slack, sums.friction - sums.coupling, 1e-5 * sums.friction);
        expect_slack_of_overshoot_alone(step.solution(), e.slack);
      });
}

// Jumps lie at dyadic points, where panels of the brute force meet.
INSTANTIATE_TEST_SUITE_P(, AnyBound,
                         ::testing::Values(Bound{"0.3", 0.9},
                                           Bound{"0.1 + 0.1*x - 0.05*x^2 + 0.02*x^3", 0.705},
                                           Bound{"if(x < 1.3125, 0, 0.8)", 1.35},
                                           Bound{"if(x < 1.3125, 0.8, 0.1)", 1.21875},
                                           Bound{"0.2*abs(x - 0.75)", 0.5625},
                                           Bound{"if(abs(x - 1.5) < 0.0625, 4, 0)", 0.5}),
                         [](const auto &info) { return "g" + std::to_string(info.index); });

TEST(Contact, APolynomialBoundTakesOnePointMoreThanTheDegreeOnEachEdge)
{
  const Scene<2> scene = pushed_with("0.1 + 0.1*x - 0.05*x^2 + 0.02*x^3");
  const RandomMesh mesh(scene, 3, 2);
  const Laboratory discrete(scene, mesh);
  for (const ContactFace<2> &face : discrete.contact_space.faces())
    EXPECT_EQ(face.friction.points.size(), face.degree + 1);
}

/** int |u_t| for u_t = c (x - a) (x - b) on the edge (0,1), whose zeros lie on a sample, between two, and beside an end. */
TEST(Contact, SeesWhereTheDisplacementChangesItsSign)
{
  const Scene<2> scene =
      scene_of({{"Boundary top/Displacement", "0; 0"}, given::rough("bottom", "bilateral", "3")});
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  for (const auto &[a, b] : std::vector<std::pair<double, double>>{
           {0.5, 2.}, {0.51, 0.52}, {0., 0.01}, {0.985, 1.}, {0.3, 0.3}})
    for (const double c : {1., -1.})
      for (const unsigned int p : {2U, 3U, 6U})
      {
        const Laboratory discrete(scene, mesh, Degrees(1, p));
        Vector<double> u(discrete.displacement_space.n_dofs()),
            lambda(discrete.contact_space.n_multipliers());
        const VectorFunctionFromScalarFunctionObject<2> slip(
            [a = a, b = b, c](const Point<2> &x) { return c * (x[0] - a) * (x[0] - b); }, 0, 2);
        VectorTools::interpolate(discrete.displacement_space.dof_handler(), slip, u);
        const Solution<2> solution(scene, discrete.spaces, u, lambda);
        const Energies e =
            energies<2>(SolutionField<2>(solution), 0., discrete.system.work(solution.u));
        double exact = 0;
        const auto primitive = [a = a, b = b](const double x)
        { return ((x / 3 - (a + b) / 2) * x + a * b) * x; };
        const std::array<double, 4> ends{{0., a, std::min(b, 1.), 1.}};
        for (unsigned int k = 0; k < 3; ++k)
          exact += std::abs(primitive(ends[k + 1]) - primitive(ends[k]));
        EXPECT_NEAR(e.slack, 3 * exact, 1e-14) << "a = " << a << ", b = " << b << ", p = " << p;
      }
}

/** A bump between the points of the multiplier is warned of, bisected, and no more warned of then. */
TEST(CoarseBound, IsWarnedOfUntilItIsResolved)
{
  const std::string bump = "0.2 + 3*exp(-400*(x - 1.3)^2)"; // smooth: nothing jumps
  for (const std::string method : {"hpa3", "pu"})
  {
    unsigned int n_unresolved = 0, steps = 0;
    std::vector<std::string> warnings;
    each_step<2>(
        pushed_with(bump, {{"Adaptivity/Method", method}}),
        [&](const StepReport<2> &step)
        {
          EXPECT_TRUE(step.solution().contact_space.unresolved_jumps(step.solution().z).empty());
          n_unresolved = step.solution().contact_space.unresolved_bounds(step.solution().z).size();
          EXPECT_TRUE(n_unresolved > 0 || step.number > 2);
          ++steps;
          warnings = texts(step.warnings);
        });
    EXPECT_EQ(steps, 6U);
    EXPECT_EQ(n_unresolved > 0, method == "pu");
    EXPECT_EQ(mentions(warnings, "more than the multiplier's points see"), method == "pu");
  }
}

/** The numbers of the warning are those of the edge: one edge, p = 3, points at 1/2 -+ 1/sqrt(12). */
TEST(CoarseBound, IsNamedWithItsSumAndItsIntegral)
{
  const Scene<2> scene =
      scene_of({{"Boundary top/Displacement", "0; 0"}, given::rough("bottom", "bilateral", "x^4")});
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  const Laboratory discrete(scene, mesh, Degrees(1, 3));
  const Vector<double> any; // Tresca's law asks for no pressure
  const auto bounds = discrete.contact_space.unresolved_bounds(any);
  ASSERT_EQ(bounds.size(), 1U);
  EXPECT_NEAR(bounds[0].integral, 0.2, 1e-14);
  EXPECT_NEAR(bounds[0].sum, 7. / 36, 1e-14);
  EXPECT_NEAR(discrete.contact_space.friction_limit(), 0.2, 1e-14);
  EXPECT_NEAR(discrete.contact_space.discrete_friction_limit(), 7. / 36, 1e-14);
  EXPECT_TRUE(Laboratory(scene, mesh, Degrees(1, 4)).contact_space.unresolved_bounds(any).empty());
}

// ---------------------------------------------------------------- bodies that friction holds

/** A strip 4 x 1 without supports, pushed along the top by @p force. */
Scene<2> free_strip(const std::string &bound, const double force, const Overrides &more = {})
{
  return scene_of(with({given::box("4, 1", "4, 1"),
                        {"Material/Young's modulus", "1"},
                        {"Boundary left/Traction", in_digits(force) + "; 0"},
                        given::rough("bottom", "bilateral", bound),
                        given::steps("hpa3", "3")},
                       more));
}

/** int g = 5.4, of which the Gauss points of the first mesh see 5. */
TEST(FreeBody, IsHeldByTheIntegralOfADiscontinuousBound)
{
  const std::string g = "if(x < 1.3, 0, 2)";
  EXPECT_EQ(failure_of(free_strip(g, 4.99)), "");
  std::string failure = failure_of(free_strip(g, 5.01));
  EXPECT_NE(failure.find("with 5.01, contact can resist with 5 there and 5.4 on a fine one"),
            std::string::npos)
      << failure;
  EXPECT_EQ(failure_of(free_strip(g, 5.39, {{"Geometry/Subdivisions", "40, 10"}})), "");
  failure = failure_of(free_strip(g, 5.41, {{"Geometry/Subdivisions", "40, 10"}}));
  EXPECT_NE(failure.find("no equilibrium"), std::string::npos) << failure;
  EXPECT_NE(failure.find("the loads push with 5.41, friction resists with 5.4;"), std::string::npos)
      << failure;
}

TEST(FreeBody, BalancesItsLoadsByABump)
{
  // wherever it lies, as long as the mesh sees it
  for (const double a : {0.93, 1.31, 2., 2.49})
  {
    double resultant = 0;
    each_step<2>(free_strip("if(abs(x - " + in_digits(a) + ") < 0.05, 10, 0)", 0.7,
                            {{"Geometry/Subdivisions", "80, 10"}}),
                 [&](const StepReport<2> &step)
                 { resultant = step.contact.at(0).friction_resultant; });
    EXPECT_NEAR(resultant, -0.7, 1e-9) << a;
  }
}

TEST(FreeBody, ABoundThatNoSampleSeesIsAFailureWithItsReason)
{
  const std::string bump = "if(abs(x - 2) < 0.0001, 1e5, 0)";
  const std::string failure = failure_of(free_strip(bump, 0.75));
  EXPECT_NE(failure.find("the loads push with 0.75, friction resists with 0,"), std::string::npos)
      << failure;
  EXPECT_NE(failure.find("Subdivisions"), std::string::npos) << failure;
  // without loads along the contact it needs no friction, but nobody knows its place
  std::vector<std::string> warnings;
  each_step<2>(free_strip(bump, 0, {{"Boundary top/Traction", "0; -1"}}),
               [&](const StepReport<2> &step)
               {
                 warnings = texts(step.warnings);
                 EXPECT_NEAR(step.energies.norm, std::sqrt(4. * (1 - 0.09)), 1e-10);
               });
  EXPECT_TRUE(mentions(warnings, "its place is not unique"));
  // found with a finer mesh
  EXPECT_EQ(failure_of(free_strip(bump, 0.7, {given::graded("Geometry", "2, 0", "13")})), "");
}

// ---------------------------------------------------------------- jumps inside an edge

double edge_with_the_jump(const Solution<2> &solution, const double jump)
{
  for (const ContactFace<2> &face : solution.contact_space.faces())
    if ((face.point(0.)[0] - jump) * (face.point(1.)[0] - jump) < 0)
      return face.length;
  return 0;
}

TEST(Jump, IsBisectedInEveryStepByMethodsThatBisect)
{
  for (const std::string method : {"hap2", "hpa1", "hpa2", "hpa3"})
  {
    double expected = 1;
    each_step<2>(pushed_with("if(x < 1.3, 0.2, 0.3)", {{"Adaptivity/Method", method}}),
                 [&](const StepReport<2> &step)
                 {
                   EXPECT_LE(edge_with_the_jump(step.solution(), 1.3), expected)
                       << method << ", step " << step.number;
                   expected /= 2;
                 });
  }
}

TEST(Jump, IsWarnedOfUnlessAVertexLiesThere)
{
  const auto warnings_of = [](const std::string &bound, const std::string &method)
  {
    std::vector<std::string> result;
    each_step<2>(pushed_with(bound, {given::steps(method, "2")}),
                 [&](const StepReport<2> &step) { result = texts(step.warnings); });
    return result;
  };
  const std::string words = "Friction bound jumps inside 1 edge, by up to 0.1";
  EXPECT_TRUE(mentions(warnings_of("if(x < 1.3, 0.2, 0.3)", "pu"),
                       words + " at (1.3 0) in an edge of length 1"));
  EXPECT_TRUE(mentions(warnings_of("if(x < 1.3, 0.2, 0.3)", "hup2"),
                       words + " at (1.3 0) in an edge of length 0.5"));
  EXPECT_FALSE(mentions(warnings_of("if(x < 2, 0.2, 0.3)", "pu"), "jumps"));
  EXPECT_FALSE(mentions(warnings_of("0.2 + 0.1*abs(x - 1.3)", "pu"), "jumps"));
  EXPECT_FALSE(mentions(warnings_of("if(x < 1.3, 0.2, 0.2 + 1e-8)", "pu"), "jumps"));
}

// ---------------------------------------------------------------- states

/** A solution with given multipliers; displacements are zero. */
class Multipliers
{
public:
  explicit Multipliers(const Scene<2> &scene, const unsigned int p)
      : mesh(scene, p), discrete(scene, mesh.triangulation, mesh.degrees),
        u(discrete.displacement_space.n_dofs()), lambda(discrete.contact_space.n_multipliers())
  {
  }

  /** lambda at x becomes @p value(x). */
  std::vector<Point<2>> transitions_of(const std::function<double(const Point<2> &)> &value)
  {
    for (const ContactFace<2> &face : discrete.contact_space.faces())
      for (unsigned int i = 0; i < face.n_multipliers; ++i)
      {
        const Point<2> x = face.point(QGauss<1>(face.n_multipliers).point(i)[0]);
        lambda[face.first_multiplier + i] = value(x) * face.friction_bound(x);
      }
    return transitions(
        contact_states(SolutionField(Solution<2>(discrete.scene, discrete.spaces, u, lambda))));
  }

private:
  struct Mesh
  {
    Triangulation<2> triangulation;
    Degrees degrees;

    Mesh(const Scene<2> &scene, const unsigned int p)
    {
      make_mesh(scene, triangulation);
      degrees.assign(triangulation.n_active_cells(), p);
    }
  };

  const Mesh mesh;
  const Laboratory discrete;
  const Vector<double> u;
  Vector<double> lambda;
};

/** Ten edges of length 1 with two Gauss points each. */
Scene<2> strip(const std::string &bound = "1")
{
  return scene_of({given::box("10, 1", "10, 1"),
                   {"Boundary top/Displacement", "0; 0"},
                   given::rough("bottom", "bilateral", bound)});
}

TEST(Transitions, LieBetweenGaussPointsOfDifferentState)
{
  const Scene<2> scene = strip();
  Multipliers multipliers(scene, 3);
  const auto found =
      multipliers.transitions_of([](const Point<2> &x) { return x[0] < 3 ? 1. : 0.5; });
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].distance(Point<2>(3, 0)), 0, 1e-14);
  // slip one way, stick, slip the other way; and the turn of the slip from point to point
  EXPECT_EQ(
      multipliers
          .transitions_of([](const Point<2> &x) { return x[0] < 3   ? -1.
                                                         : x[0] < 7 ? 0.
                                                                    : 1.; })
          .size(),
      2U);
  EXPECT_EQ(
      multipliers.transitions_of([](const Point<2> &x) { return x[0] < 5 ? -1. : 1.; }).size(), 1U);
  EXPECT_TRUE(multipliers.transitions_of([](const Point<2> &) { return -1.; }).empty());
}

TEST(Transitions, AnEvenNumberOfChangesNearEachOtherIsNone)
{
  const Scene<2> scene = strip();
  Multipliers multipliers(scene, 3);
  const auto sticks_between = [&](const double a, const double b)
  {
    return multipliers.transitions_of([=](const Point<2> &x)
                                      { return a < x[0] && x[0] < b ? 0.5 : 1.; });
  };
  EXPECT_TRUE(sticks_between(4, 5).empty());
  EXPECT_EQ(sticks_between(4, 8).size(), 2U);
  // slip, one point of stick, one of slip, stick: three changes are one, in their middle
  const auto three = multipliers.transitions_of(
      [](const Point<2> &x) { return x[0] < 4 || (x[0] > 4.5 && x[0] < 5) ? 1. : 0.5; });
  ASSERT_EQ(three.size(), 1U);
  EXPECT_NEAR(three[0][0], 4.5, 1e-14);
}

TEST(Transitions, WithoutFrictionTheBodySlips)
{
  const Scene<2> scene = strip("if(x < 3, 0, 1)");
  Multipliers multipliers(scene, 3);
  const auto found = multipliers.transitions_of([](const Point<2> &) { return 0.5; });
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0][0], 3, 0.3);
  for (const double z : {-1., 1.})
    EXPECT_TRUE(multipliers.transitions_of([z](const Point<2> &) { return z; }).empty());
}

/** A square block in a corner: on the bottom and on the left friction resists. */
Scene<2> block_in_a_corner(const Overrides &more = {})
{
  return scene_of(with({{"Geometry/Subdivisions", "4, 4"},
                        {"Material/Young's modulus", "1"},
                        given::rough("bottom", "bilateral", "0.3"),
                        given::rough("left", "bilateral", "0.3"),
                        {"Boundary top/Traction", "0.3; -1"},
                        {"Boundary right/Traction", "0.5; 0"},
                        given::steps("hpa3", "5")},
                       more));
}

TEST(TwoContactBoundaries, HaveTransitionsOfTheirOwn)
{
  const Scene<2> scene = block_in_a_corner({{"Geometry/Subdivisions", "8, 8"}});
  Multipliers multipliers(scene, 4);
  // One slips, the other sticks: no transition at the corner or between their far ends.
  EXPECT_TRUE(
      multipliers.transitions_of([](const Point<2> &x) { return x[1] == 0. ? 1. : 0.5; }).empty());
  // Along t = (0,-1) on the left, then along t = (1,0) on the bottom.
  const auto found = multipliers.transitions_of(
      [](const Point<2> &x)
      { return x[1] == 0. ? (x[0] < 0.25 || x[0] > 0.75 ? 1. : 0.) : (x[1] > 0.5 ? -1. : 0.2); });
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0].distance(Point<2>(0, 0.5)), 0, 1e-14);
  EXPECT_NEAR(found[1].distance(Point<2>(0.25, 0)), 0, 1e-14);
  EXPECT_NEAR(found[2].distance(Point<2>(0.75, 0)), 0, 1e-14);
}

TEST(TwoContactBoundaries, HaveNoTransitionInsideTheBodyAndNoCommonResultant)
{
  unsigned int n_transitions = 0;
  each_step<2>(block_in_a_corner(),
               [&](const StepReport<2> &step)
               {
                 EXPECT_EQ(step.contact.size(), 2U);
                 for (const Point<2> &x : transitions(step.contact))
                 {
                   EXPECT_TRUE(x[0] == 0. || x[1] == 0.) << x;
                   ++n_transitions;
                 }
               });
  EXPECT_GT(n_transitions, 0U);
}

TEST(TwoContactBoundaries, TablesRunAlongTheTangentOfEach)
{
  const Scene<2> scene = block_in_a_corner();
  const RandomMesh mesh(scene, 5, 2);
  const Laboratory discrete(scene, mesh);
  std::mt19937 random(5);
  const Solution<2> field = discrete.random_field(random);
  const std::vector<ContactState<2>> states = contact_states(SolutionField(field));
  ASSERT_EQ(states.size(), 2U);
  EXPECT_EQ(states[0].boundary, 0U);
  EXPECT_EQ(states[1].boundary, 2U);
  for (const ContactState<2> &state : states)
  {
    double last = -2;
    auto point = state.points.begin();
    for (const ContactFace<2> &face : discrete.contact_space.faces())
      for (unsigned int q = 0; q < face.n_points && face.condition->id == state.boundary; ++q)
      {
        ASSERT_NE(point, state.points.end());
        EXPECT_NEAR(point->lambda * point->friction_bound,
                    discrete.contact_space.value(face, field.z,
                                                 point->x.distance(face.point(0.)) / face.length),
                    1e-10);
        const double place = face.frame(0.5).tangent * point->x;
        EXPECT_GT(place, last);
        last = place;
        ++point;
      }
    EXPECT_EQ(point, state.points.end());
  }
}

/** A displacement with sigma_yy = x - 1 on the bottom of a block of length 4: it pulls beyond x = 1. */
TEST(ContactState, ResultantsAreIntegrals)
{
  const Scene<2> scene = scene_of({given::box("4, 1", "8, 1"),
                                   given::elastic("1", "0"),
                                   {"Boundary top/Displacement", "0; 0"},
                                   given::rough("bottom", "bilateral", "if(x < 3, 0.5, 0)")});
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  const Laboratory discrete(scene, mesh, Degrees(mesh.n_active_cells(), 3));
  Vector<double> u(discrete.displacement_space.n_dofs()),
      lambda(discrete.contact_space.n_multipliers());
  const VectorFunctionFromScalarFunctionObject<2> rising(
      [](const Point<2> &x) { return (x[0] - 1) * x[1]; }, 1, 2);
  VectorTools::interpolate(discrete.displacement_space.dof_handler(), rising, u);
  lambda = 0.3;
  const std::vector<ContactState<2>> states =
      contact_states(SolutionField(Solution<2>(scene, discrete.spaces, u, lambda)));
  ASSERT_EQ(states.size(), 1U);
  EXPECT_NEAR(states[0].area, 4, 1e-14);
  EXPECT_NEAR(states[0].normal_resultant, 4, 1e-12);
  EXPECT_NEAR(states[0].tension, 4.5, 1e-12);
  EXPECT_NEAR(states[0].highest_tension_point.distance(Point<2>(4, 0)), 0, 0.1);
  EXPECT_NEAR(states[0].highest_tension, states[0].highest_tension_point[0] - 1, 1e-12);
  EXPECT_NEAR(states[0].friction_resultant, -0.9, 1e-12);
  EXPECT_NEAR((states[0].friction_force - Tensor<1, 2>({-0.9, 0})).norm(), 0, 1e-12);
  for (const ContactPoint<2> &point : states[0].points)
  {
    EXPECT_NEAR(point.normal_traction, point.x[0] - 1, 1e-12);
    EXPECT_EQ(point.tangential_traction, point.x[0] < 3 ? -0.3 : 0.);
    EXPECT_EQ(point.slips, point.x[0] > 3);
  }
}

TEST(ContactState, SlipsWhereLambdaIsOneUpToTheTolerance)
{
  const Scene<2> scene = strip();
  Multipliers multipliers(scene, 3);
  for (const double sign : {-1., 1.})
  {
    const auto at_the_edge = [&](const double distance)
    {
      return multipliers
          .transitions_of([=](const Point<2> &x)
                          { return x[0] < 3 ? 0. : sign * (1 - distance * slip_tolerance); })
          .size();
    };
    EXPECT_EQ(at_the_edge(0.9), 1U);
    EXPECT_EQ(at_the_edge(1.1), 0U);
  }
}

// ---------------------------------------------------------------- loads on the contact boundary

/**
 * Uniform stress sigma_xy = tau, sigma_yy = -P in a block with nu = 0: u = (gamma y + slip, -P y/E).
 * On the bottom sigma n = (-tau, P) is the traction G applied there and that of the contact.
 */
struct LoadedFoot
{
  double tau, pressure, along, up; ///< along, up: G

  Scene<2> scene(const double slip, const double bound, const Overrides &more = {}) const
  {
    return scene_of(with(
        {given::box("2, 1", "2, 1"),
         given::elastic("1", "0"),
         {"Boundary top/Displacement", in_digits(slip + 2 * tau) + "; " + in_digits(-pressure)},
         {"Boundary left/Traction", "0; " + in_digits(-tau)},
         {"Boundary right/Traction", "0; " + in_digits(tau)},
         given::rough("bottom", "bilateral", in_digits(bound)),
         {"Boundary bottom/Traction", in_digits(along) + "; " + in_digits(up)},
         given::steps("hup3", "1")},
        more));
  }
};

void expect_uniform(const LoadedFoot &foot, const Scene<2> &scene, const double traction)
{
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        const ShapeTables<2> tables;
        EXPECT_LE(step.estimate.total(), 1e-12);
        for (const double z : step.solution().z)
          EXPECT_NEAR(z, traction, 1e-10);
        for (const ContactFace<2> &face : step.solution().contact_space.faces())
        {
          const ContactTraces<2> traces(face, 3, step.solution());
          for (unsigned int q = 0; q < 3; ++q)
            EXPECT_NEAR(traces.normal_traction(q), -foot.pressure + foot.up, 1e-12);
        }
        EXPECT_EQ(mentions(texts(step.warnings), "contact pulls"), foot.up > foot.pressure);
      });
}

TEST(LoadedFoot, TractionsAreThoseOfTheContactAlone)
{
  // z = tau + along, or g where that is less; the indicator vanishes with the right sign of G alone
  for (const double up : {0., 0.1, 0.5})
  {
    const LoadedFoot foot{0.05, 0.2, 0.1, up};
    expect_uniform(foot, foot.scene(0, 0.3), 0.15);
    expect_uniform(foot, foot.scene(0.01, 0.15), 0.15);
  }
  const LoadedFoot frictionless{0.05, 0.2, -0.05, 0.1};
  expect_uniform(frictionless, frictionless.scene(0.01, 0.), 0.);
}
} // namespace
