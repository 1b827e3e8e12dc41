// SPDX-License-Identifier: LGPL-2.1-or-later
// Friction coefficients and gaps that vary between the points of the discrete problem: found, marked
// and warned of until the mesh resolves them.
#include "discretisation.h"

#include <hpvi/results/unseen_contact.h>

namespace
{
using namespace verification;

/** The unit square of 4 x 4 cells, pressed down and to the right over its bottom. */
Scene<2> pressed(const Overrides &more)
{
  return scene_of(with({{"Geometry/Subdivisions", "4, 4"},
                        given::elastic("1", "0.3"),
                        {"Boundary bottom/Contact", "unilateral"},
                        {"Boundary top/Displacement", "0.03; -0.02"},
                        {"Adaptivity/Method", "hpa3"},
                        {"Units/Length", "mm"},
                        {"Units/Stress", "MPa"}},
                       more));
}

/** All lines, to be shown where a test fails. */
std::string in_lines(const std::vector<std::string> &lines)
{
  std::string result;
  for (const std::string &line : lines)
    result += line + "\n";
  return result;
}

// ---------------------------------------------------------------- friction coefficients

/** int mu_f p by many short panels. */
double friction_by_panels(const Solution<2> &solution)
{
  const unsigned int n_panels = 2000;
  double sum = 0;
  for (const ContactFace<2> &face : solution.contact_space.faces())
    for (unsigned int k = 0; k < n_panels; ++k)
    {
      const double s = (k + 0.5) / n_panels;
      sum += face.length / n_panels * face.friction_coefficient(face.point(s)) *
             solution.contact_space.pressure(face, solution.z, s);
    }
  return sum;
}

struct Coefficient
{
  std::string name, mu;
  bool jumps; ///< edges with a jump are named until they carry next to nothing
};

/** Bytes of it, which GoogleTest would print, are not all set. */
std::ostream &operator<<(std::ostream &out, const Coefficient &coefficient)
{
  return out << coefficient.name;
}

using AnyCoefficient = ::testing::TestWithParam<Coefficient>;

/** The body slips everywhere: friction is int mu_f p wherever no edge is said to miss it, and in the end. */
TEST_P(AnyCoefficient, IsIntegratedOrWarnedOf)
{
  const Coefficient &given = GetParam();
  for (const std::string steps : {"1", "14"})
    each_step<2>(pressed({{"Boundary bottom/Friction coefficient", given.mu},
                          {"Adaptivity/Maximum steps", steps}}),
                 [&](const StepReport<2> &step)
                 {
                   const ContactSpace<2> &space = step.solution().contact_space;
                   const bool warned = !space.unresolved_bounds(step.solution().z).empty() ||
                                       !space.unresolved_jumps(step.solution().z).empty();
                   EXPECT_TRUE(warned || step.number > 1);
                   const double expected = -friction_by_panels(step.solution()),
                                found = step.contact.at(0).friction_resultant;
                   EXPECT_LT(expected, 0.);
                   if (!warned || step.number == 14)
                   {
                     EXPECT_NEAR(found, expected, 0.01 * std::abs(expected))
                         << "step " << step.number;
                   }
                   if (!step.stopped_by.empty())
                   {
                     EXPECT_EQ(mentions(texts(step.warnings), "Friction coefficient varies inside"),
                               steps == "1" || given.jumps)
                         << in_lines(texts(step.warnings));
                   }
                   EXPECT_FALSE(mentions(texts(step.warnings), "Friction bound"));
                 });
}

INSTANTIATE_TEST_SUITE_P(, AnyCoefficient,
                         ::testing::Values(Coefficient{"step", "if(abs(x-0.37)<0.02,1,0.1)", true},
                                           Coefficient{"spike", "if(abs(x-0.431)<0.004,5,0)", true},
                                           Coefficient{"bell", "2*exp(-((x-0.37)/0.005)^2)",
                                                       false}),
                         [](const auto &info) { return info.param.name; });

/** The numbers of the warning: one edge, p = 3, the pressure 1 and mu_f = x^4 at 1/2 -+ 1/sqrt(12). */
TEST(CoarseCoefficient, IsNamedWithItsSumAndItsIntegral)
{
  const Scene<2> scene = scene_of({{"Boundary top/Displacement", "0; 0"},
                                   {"Boundary bottom/Contact", "unilateral"},
                                   {"Boundary bottom/Friction coefficient", "x^4"}});
  EXPECT_TRUE(PressedEdge(scene).bounds(0.).empty()); // nothing presses
  const auto bounds = PressedEdge(scene).bounds(1.);
  ASSERT_EQ(bounds.size(), 1U);
  EXPECT_NEAR(bounds[0].integral, 0.2, 1e-14);
  EXPECT_NEAR(bounds[0].sum, 7. / 36, 1e-14);
  EXPECT_TRUE(PressedEdge(scene, 5).bounds(1.).empty());
}

/** A jump where nothing presses changes no friction. */
TEST(JumpOfTheCoefficient, CountsWhereContactPresses)
{
  const Overrides jump = {{"Boundary bottom/Friction coefficient", "if(x < 0.9, 0.1, 0.3)"},
                          {"Boundary top/Displacement", "0; -0.02 + 0.08*x"},
                          {"Adaptivity/Maximum steps", "2"}};
  const auto warnings_of = [](const Scene<2> &scene)
  {
    std::vector<std::string> result;
    AdaptiveSolver<2>(scene).run([&](const StepReport<2> &step) { result = texts(step.warnings); });
    return result;
  };
  const std::vector<std::string> open = warnings_of(pressed(jump));
  EXPECT_FALSE(mentions(open, "Friction coefficient jumps")) << in_lines(open);
  EXPECT_TRUE(mentions(
      warnings_of(
          pressed(with(jump, {{"Boundary bottom/Friction coefficient", "if(x < 0.1, 0.1, 0.3)"}}))),
      "Friction coefficient jumps inside 1 edge, by up to 0.2 at (0.1 0) in an edge of length "
      "0.125 mm"));
}

/** The bell is 1e-170 beside its peak: no quotient by that is worth a word. */
TEST(Overshoot, IsNotDividedByACoefficientThatVanishes)
{
  for (const std::string steps : {"1", "2"})
  {
    std::vector<std::string> lines;
    each_step<2>(pressed({{"Boundary bottom/Friction coefficient", "2*exp(-((x-0.37)/0.005)^2)"},
                          {"Adaptivity/Maximum steps", steps}}),
                 [&](const StepReport<2> &step) { lines = texts(step.warnings); });
    EXPECT_FALSE(mentions(lines, "|lambda|")) << in_lines(lines);
    // In the first step friction is 1e-80 of the pressure.
    EXPECT_EQ(mentions(lines, "where Friction coefficient times the pressure is "), steps == "2")
        << in_lines(lines);
  }
}

// ---------------------------------------------------------------- gaps

/** As many as two steps of an edge of 1/4 take to meet a bump of this width at their points. */
const std::string bump = "-0.005*exp(-((x-0.37)/0.005)^2)";

/** Wherever no edge is said to miss the gap the pressure is near that of a fine mesh; it was 0.02. */
TEST(NarrowGap, IsWarnedOfUntilThePressureIsRight)
{
  for (const std::string kind : {"nodes", "multiplier"})
  {
    double pressure = 0;
    unsigned int n_missed = 0;
    std::vector<std::string> warnings;
    each_step<2>(pressed({{"Boundary bottom/Gap", bump},
                          {"Solver/Normal contact", kind},
                          {"Adaptivity/Maximum steps", "12"}}),
                 [&](const StepReport<2> &step)
                 {
                   pressure = step.contact.at(0).highest_pressure;
                   const bool missed = !unseen_gaps(step.solution()).empty();
                   EXPECT_TRUE(missed || std::abs(pressure - 0.57) < 0.1)
                       << kind << " " << pressure;
                   n_missed += missed;
                   warnings = texts(step.warnings);
                 });
    EXPECT_GT(n_missed, 1U);
    EXPECT_LT(n_missed, 10U);
    EXPECT_NEAR(pressure, 0.57, 0.02) << kind;
    EXPECT_FALSE(mentions(warnings, "Gap varies"));
  }
}

/** The numbers: nodes of degree 3 stand for 0 where the foundation rises. */
TEST(NarrowGap, IsNamedWithItsPlace)
{
  std::vector<std::string> lines;
  each_step<2>(pressed({{"Boundary bottom/Gap", bump}, {"Adaptivity/Maximum steps", "1"}}),
               [&](const StepReport<2> &step) { lines = texts(step.warnings); });
  EXPECT_TRUE(mentions(lines, "Gap varies inside 1 edge more than the points of the contact "
                              "conditions see: near (0.37 0) it is -0.005 mm"))
      << (lines.empty() ? "" : lines[0]);
}

/** A groove is missed like a bump; one out of reach of the body is no matter. */
TEST(NarrowGap, CountsWhereTheBodyReaches)
{
  const auto n_missed = [](const std::string &gap, const std::string &down)
  {
    unsigned int result = 0;
    each_step<2>(pressed({{"Boundary bottom/Gap", gap},
                          {"Boundary top/Displacement", "0; " + down},
                          {"Adaptivity/Maximum steps", "1"}}),
                 [&](const StepReport<2> &step) { result = unseen_gaps(step.solution()).size(); });
    return result;
  };
  EXPECT_EQ(n_missed("0.005*exp(-((x-0.37)/0.005)^2)", "-0.02"), 1U);
  EXPECT_EQ(n_missed("0.1 - 0.005*exp(-((x-0.37)/0.005)^2)", "-0.02"), 0U);
  EXPECT_EQ(n_missed("if(x < 0.5, 0, 1)", "-0.02"), 0U); // a vertex stands there
  EXPECT_EQ(n_missed("if(x < 0.4, 0, 1)", "-0.02"), 1U);
  EXPECT_EQ(n_missed("0.01*x^2", "-0.02"), 0U);
  EXPECT_EQ(n_missed("0.3*(x - 0.4)^2", "0"), 0U); // a zero displacement touches up to round-off
}

TEST(NarrowGap, IsNeverSeenInSmoothScenes)
{
  for (const std::string scene : {"hertz", "punch", "punch-friction"})
    each_step<2>(
        shipped_scene(scene, {{"Adaptivity/Maximum steps", "6"}}), [&](const StepReport<2> &step)
        { EXPECT_TRUE(unseen_gaps(step.solution()).empty()) << scene << ", " << step.number; });
}
} // namespace
