// SPDX-License-Identifier: LGPL-2.1-or-later
// What a scene may ask for and what it may not: values that misbehave between the points at which
// they are tried, extremes of numbers, nothing at all.
#include "discretisation.h"

#include <hpvi/base/text.h>
#include <hpvi/output/output.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/reader/scene_reader.h>

#include <algorithm>
#include <regex>

namespace
{
using namespace verification;

/** What is left of a run. */
struct Result
{
  unsigned int steps = 0;
  bool failed_input = false, failed_numerics = false;
  std::string message, stopped_by;
  double relative = -1, scaled_estimate = -1, estimate = -1, largest = -1, condition_raw = 0;
  double friction_resultant = 0;
  Energies energies;
  std::vector<std::string> warnings;
  std::string files; ///< convergence.csv and summary.json

  bool warns(const std::string &words) const
  {
    return mentions(warnings, words);
  }
};

std::string content(const std::filesystem::path &file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

Result run(const std::string &name, const Overrides &overrides)
{
  const auto directory = std::filesystem::path(::testing::TempDir()) /
                         ("hpvi-input-" + std::to_string(std::random_device()()));
  Result result;
  const Scene<2> scene = shipped_scene(
      name, overrides + Overrides{{"Output/VTU", "false"}, {"Output/Contact tables", "false"}});
  try
  {
    Output<2> output(scene, directory.string());
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          result.steps = step.number;
          result.stopped_by = text(step.stopped_by);
          result.relative = step.relative_estimate;
          result.scaled_estimate = step.scaled_estimate;
          result.estimate = step.estimate.total();
          result.largest = step.solution().u.linfty_norm();
          result.condition_raw = step.reduced->condition_raw;
          result.energies = step.energies;
          if (!step.contact.empty())
            result.friction_resultant = step.contact[0].friction_resultant;
          result.warnings = texts(step.warnings);
          output.write_step(step);
        });
  }
  catch (const InputError &error)
  {
    result.failed_input = true;
    result.message = error.what();
  }
  catch (const NumericalFailure &failure)
  {
    result.failed_numerics = true;
    result.message = failure.what();
  }
  result.files = content(directory / "convergence.csv") + content(directory / "summary.json");
  std::filesystem::remove_all(directory);
  return result;
}

std::string steps(const unsigned int number)
{
  return std::to_string(number);
}

// ---------------------------------------------------------------- between the sampled points

/** Tried at multiples of 1/8, asked for between them. */
TEST(Expressions, AGapIsFiniteEverywhere)
{
  const Scene<2> scene = shipped_scene("han-6-12", {{"Boundary bottom/Contact", "unilateral"},
                                                    {"Boundary bottom/Gap", "1/(x-0.1)^2"}});
  EXPECT_NEAR(scene.boundaries[2].gap_at(Point<2>(1.1, 0.)), 1., 1e-14);
  const std::string message =
      failure_of<InputError>([&] { scene.boundaries[2].gap_at(Point<2>(0.1, 0.)); });
  EXPECT_EQ(message.rfind("prm/han-6-12.prm (--set): Boundary bottom/Gap = 1/(x-0.1)^2: ", 0), 0U)
      << message;
  EXPECT_TRUE(says(message, "is not finite at (0.1, 0): inf;")) << message;
}

/** The names that deal.II adds to muParser, and muParser's own. */
TEST(Expressions, KnowEveryFunction)
{
  const double x = 0.7;
  const std::vector<std::pair<std::string, double>> all{
      {"int(2.6*x)", 2.}, // the nearest
      {"ceil(x)", 1.},
      {"floor(2*x)", 1.},
      {"cot(x)", 1 / std::tan(x)},
      {"csc(x)", 1 / std::sin(x)},
      {"sec(x)", 1 / std::cos(x)},
      {"log(x)", std::log(x)},
      {"erfc(x)", std::erfc(x)},
      {"pow(x, 3)", x * x * x},
      {"if(x < 1, 2, 3)", 2.},
      {"if (x > 1, 2, 3)", 3.},
      {"(x > 1) | (x < 1)", 1.},
      {"(x > 1) & (x < 1)", 0.},
      {"sin(x) + cos(x) + tan(x)", std::sin(x) + std::cos(x) + std::tan(x)},
      {"asin(x) + acos(x) + atan(x)", numbers::PI / 2 + std::atan(x)},
      {"atan2(x, 2)", std::atan2(x, 2)},
      {"sinh(x) + cosh(x)", std::exp(x)},
      {"tanh(x)", std::tanh(x)},
      {"asinh(x) + acosh(1 + x) + atanh(x)", std::asinh(x) + std::acosh(1 + x) + std::atanh(x)},
      {"exp(ln(x)) + 2^log2(x) + 10^log10(x)", 3 * x},
      {"sqrt(x)^2 + abs(-x)", 2 * x},
      {"sign(-x) + rint(x)", 0.},
      {"min(x, 3, 2) + max(x, 0) + sum(x, x) + avg(x, 3*x)", 6 * x}};
  for (const auto &[text, value] : all)
  {
    const Scene<2> scene = shipped_scene(
        "han-6-12", {{"Boundary bottom/Contact", "unilateral"},
                     {"Boundary bottom/Gap",
                      "1 + (" + std::regex_replace(text, std::regex("\\bx\\b"), "0.7") + ")"}});
    EXPECT_NEAR(scene.boundaries[2].gap_at(Point<2>(1., 0.)), 1 + value, 1e-14) << text;
  }
}

TEST(Expressions, RoundOffBelowAZeroBoundIsZero)
{
  const Scene<2> scene =
      shipped_scene("han-6-12", {{"Boundary bottom/Friction bound", "x*(4-x) - 1e-13"}});
  EXPECT_EQ(scene.boundaries[2].friction.bound->value(Point<2>(0., 0.)), 0.);
  EXPECT_GT(scene.boundaries[2].friction.bound->value(Point<2>(1., 0.)), 2.9);
}

// ---------------------------------------------------------------- nothing at all

TEST(ZeroLoad, IsAResult)
{
  for (const std::string method : {"hup2", "hap2", "pu", "hpa1", "hpa2", "hpa3"})
    for (const std::string solver : {"mprgp", "active set"})
    {
      const Result result = run("han-6-12", {{"Boundary left/Traction", ""},
                                             {"Adaptivity/Method", method},
                                             {"Solver/QP solver", solver},
                                             {"Solver/Condition number", "true"}});
      EXPECT_EQ(result.message, "");
      EXPECT_EQ(result.steps, 1U) << method;
      EXPECT_EQ(result.stopped_by, "round-off");
      EXPECT_EQ(result.largest, 0.);
      EXPECT_EQ(result.relative, 0.);
      EXPECT_EQ(result.energies.lagrangian, 0.);
      EXPECT_EQ(result.files.find("nan"), std::string::npos) << result.files;
      EXPECT_EQ(result.files.find("inf"), std::string::npos) << result.files;
    }
}

TEST(ZeroLoad, MeetsATolerance)
{
  const Result result = run("han-6-12", {{"Boundary left/Traction", "0; 0"},
                                         {"Boundary bottom/Friction bound", ""},
                                         {"Adaptivity/Tolerance", "1e-3"}});
  EXPECT_EQ(result.steps, 1U);
  EXPECT_EQ(result.relative, 0.);
}

/** a(u,u) is round-off of either sign, its root not nan. */
TEST(ZeroStrain, HasANorm)
{
  const Result result = run("han-6-12", {{"Boundary left/Traction", ""},
                                         {"Boundary right/Displacement", "1; 0"},
                                         {"Boundary bottom/Friction bound", ""},
                                         {"Adaptivity/Maximum steps", "3"}});
  EXPECT_EQ(result.message, "");
  EXPECT_NEAR(result.largest, 1., 1e-12);
  EXPECT_GE(result.energies.norm, 0.);
  EXPECT_EQ(result.files.find("nan"), std::string::npos) << result.files;
}

// ---------------------------------------------------------------- extremes of numbers

/** Stresses by @p factor, a power of 2: the same problem in another unit. */
Overrides in_units(const double factor)
{
  return {{"Material/Young's modulus", in_digits(15 * factor)},
          {"Boundary left/Traction",
           in_digits(1.5 * factor) + "*(5 - y); " + in_digits(-0.75 * factor)},
          {"Boundary bottom/Friction bound", in_digits(4.5 * factor)},
          {"Adaptivity/Maximum steps", "8"}};
}

TEST(Extremes, ResultsScaleWithTheUnit)
{
  const Result one = run("han-6-12", in_units(1.));
  for (const double factor : {std::ldexp(1., -300), std::ldexp(1., 300)})
  {
    const Result other = run("han-6-12", in_units(factor));
    EXPECT_EQ(other.message, "");
    EXPECT_NEAR(other.energies.lagrangian / factor / one.energies.lagrangian, 1., 1e-10);
    EXPECT_NEAR(other.energies.slack / factor / one.energies.slack, 1., 1e-6);
    EXPECT_NEAR(other.relative / one.relative, 1., 1e-10);
    EXPECT_NEAR(other.largest / one.largest, 1., 1e-10);
  }
}

TEST(Extremes, AHugeFrictionBoundIsFullStick)
{
  const auto with_bound = [](const std::string &g)
  {
    return run("han-6-12",
               {{"Boundary bottom/Friction bound", g}, {"Adaptivity/Maximum steps", "8"}});
  };
  const Result large = with_bound("1e6"), huge = with_bound("1e30");
  EXPECT_NEAR(huge.energies.lagrangian, large.energies.lagrangian, 1e-10);
  EXPECT_NEAR(huge.friction_resultant, large.friction_resultant, 1e-9);
  EXPECT_NEAR(huge.relative / large.relative, 1., 1e-9);
  // The functional itself holds g |u_t| of a displacement that sticks up to its own error.
  EXPECT_NEAR(huge.energies.slack / large.energies.slack / 1e24, 1., 1e-6);
}

TEST(Extremes, WhatOverflowsIsCalledByItsName)
{
  const Result result = run("han-6-12", {{"Material/Young's modulus", "1e100"},
                                         {"Boundary right/Displacement", "1e100; 0"},
                                         {"Geometry/Upper corner", "4e60, 4e60"},
                                         {"Body force/Expression", "1e100; 0"},
                                         {"Boundary bottom/Friction bound", ""}});
  EXPECT_TRUE(result.failed_numerics);
  EXPECT_TRUE(says(result.message, "is not finite")) << result.message;
  EXPECT_TRUE(says(result.message, "choose units")) << result.message;
}

TEST(Extremes, WhatUnderflowsIsCalledByItsName)
{
  const Result result = run("han-6-12", {{"Material/Young's modulus", "1e100"},
                                         {"Boundary left/Traction", "1e-99; 0"},
                                         {"Boundary bottom/Friction bound", ""}});
  EXPECT_TRUE(result.failed_numerics);
  EXPECT_TRUE(says(result.message, "underflows")) << result.message;
}

TEST(Extremes, AConditionNumberThatIsNoneIsExplained)
{
  // S carries the squares of lengths that fall to 1e-12.
  const Result result = run("han-6-12", {given::graded("Geometry", "0, 0", "40"),
                                         {"Solver/Condition number", "true"},
                                         {"Adaptivity/Maximum steps", "1"}});
  EXPECT_EQ(result.message, "");
  EXPECT_FALSE(std::isfinite(result.condition_raw));
  EXPECT_TRUE(result.warns("in step 1: there the table has no condition number"));
  EXPECT_EQ(result.files.substr(0, result.files.find('{')).find("inf"), std::string::npos);
}

// ---------------------------------------------------------------- material

TEST(Coercivity, IsTheSmallestEigenvalueOfHookesLaw)
{
  for (const double poisson : {-0.9, -0.5, 0., 0.3, 0.499})
    for (const PlaneModel plane : {PlaneModel::stress, PlaneModel::strain})
    {
      const Material material{15., poisson, plane};
      double smallest = std::numeric_limits<double>::max();
      for (unsigned int k = 0; k < 360; ++k) // principal strains suffice
      {
        const double a = std::cos(k * numbers::PI / 180), b = std::sin(k * numbers::PI / 180);
        smallest = std::min(smallest, material.lambda(2) * (a + b) * (a + b) + 2 * material.mu());
      }
      EXPECT_NEAR(material.coercivity(2), smallest, 1e-12 * smallest) << poisson;
    }
}

TEST(Coercivity, ScalesTheIndicator)
{
  const auto factor = [](const std::string &poisson)
  {
    const Result result = run("han-6-12", {{"Material/Poisson's ratio", poisson},
                                           {"Material/Plane", "strain"},
                                           {"Adaptivity/Maximum steps", "1"}});
    return result.estimate / result.scaled_estimate;
  };
  EXPECT_NEAR(factor("-0.5"), std::sqrt(15.), 1e-12); // E/((1+nu)(1-2nu))
  EXPECT_NEAR(factor("0.25"), std::sqrt(12.), 1e-12); // E/(1+nu)
}

TEST(Messages, PoissonsRatioHasTheDigitsItHas)
{
  for (const std::string poisson : {"0.4999999", "0.4999999999999"})
    EXPECT_TRUE(run("han-6-12", {{"Material/Poisson's ratio", poisson},
                                 {"Material/Plane", "strain"},
                                 {"Adaptivity/Maximum steps", "1"}})
                    .warns("Poisson's ratio " + poisson + " is near 1/2"));
}

// ---------------------------------------------------------------- what stops a run, corners, ids

TEST(EmptyMarking, NamesItsEntry)
{
  const auto stopped_by = [](const Overrides &entries)
  {
    const Result result =
        run("han-6-12", entries + Overrides{{"Adaptivity/Maximum steps", steps(3)}});
    EXPECT_EQ(result.steps, 1U);
    return result.stopped_by;
  };
  EXPECT_EQ(stopped_by({{"Adaptivity/Method", "hpa3"}, {"Adaptivity/hpa3 threshold", "1"}}),
            "hpa3 threshold");
  EXPECT_EQ(stopped_by({{"Adaptivity/Method", "hap2"},
                        {"Adaptivity/hap threshold", "1"},
                        {"Geometry/Subdivisions", "1, 1"}}),
            "hap threshold");
  EXPECT_EQ(
      stopped_by({{"Adaptivity/Method", "hpa2"}, {"Adaptivity/hpa2 marked fraction", "1e-12"}}),
      "hpa2 marked fraction");
  EXPECT_EQ(stopped_by({{"Adaptivity/Method", "hpa1"},
                        {"Adaptivity/hpa1 bisected fraction", "1e-12"},
                        {"Adaptivity/hpa1 raised fraction", "1e-12"}}),
            "hpa1 bisected fraction");
  EXPECT_EQ(stopped_by({{"Adaptivity/Method", "pu"}, {"Adaptivity/Maximum degree", "2"}}),
            "Maximum degree");
}

TEST(Corners, AreWarnedOfBelowFiveAndAbove175Degrees)
{
  const auto result = [](const std::string &corners)
  {
    return run("han-6-12", {given::quadrilateral("Geometry", corners),
                            {"Geometry/Lower corner", "0, 0"},
                            {"Boundary bottom/Contact", "none"},
                            {"Boundary bottom/Friction bound", ""},
                            {"Adaptivity/Maximum steps", "1"}});
  };
  EXPECT_TRUE(
      result("0,0; 4,0; 8,0.2797071; 4,0.2797071").warns("4 degrees at (0 0), 176 degrees"));
  EXPECT_TRUE(result("0,0; 4,0; 4,4; 1.95,2.05").warns("177.1 degrees at (1.95 2.05)"));
  EXPECT_FALSE(result("0,0; 4,0; 8,0.5; 4,0.5").warns("corners of"));
}

TEST(Boundaries, AFaceOfNoneIsNoticed)
{
  Scene<2> scene = shipped_scene("han-6-12");
  scene.boundaries.pop_back();
  Triangulation<2> mesh;
  EXPECT_ANY_THROW(make_mesh(scene, mesh));
}

// ---------------------------------------------------------------- messages

/** An entry that contradicts the one at hand is quoted, too: InputError is one line for users of the library as well. */
TEST(Messages, QuoteOtherEntriesPrintably)
{
  const std::string control("1\0\x01", 3);
  for (const Overrides &bad : {Overrides{{"Boundary top/Pressure", control}},
                               Overrides{{"Boundary top/Force", "1; free"},
                                         {"Boundary top/Displacement", control + "; free"}}})
  {
    const std::string line = failure_of<InputError>(
        [&] {
          shipped_scene("han-6-12", Overrides{{"Boundary top/Rigid", "true"}} + bad);
        });
    EXPECT_TRUE(says(line, "contradicts " + bad.back().first + " = 1")) << line;
    EXPECT_EQ(line, printable(line, 2000));
  }
}

TEST(Messages, ArePrintable)
{
  EXPECT_EQ(printable("a\tb\nc\r"), "a b c ");
  EXPECT_EQ(printable(std::string("\x1b[31m\0\x7f", 7)), "?[31m??");
  EXPECT_EQ(printable("\u00e9 \u20ac \U0001F600"), "\u00e9 \u20ac \U0001F600");
  EXPECT_EQ(printable("\u0085\u2028\u202e"), "???");
  EXPECT_EQ(printable("\xe9 \xc0\xaf \xed\xa0\x80 \xf5 \xe2\x82"), "? ?? ??? ? ??");
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????"); // beyond U+10FFFF
  EXPECT_EQ(printable("\xf9\x80\x80\x80"), "????"); // no first byte
  EXPECT_EQ(printable("abcdef", 6), "abcdef");
  EXPECT_EQ(printable("abcdefg", 6), "abcdef...");
  EXPECT_EQ(printable("abcde\u00e9", 6), "abcde..."); // no half characters
}
} // namespace
