// SPDX-License-Identifier: LGPL-2.1-or-later
// Each warning where it belongs, and not where it does not.
#include "discretisation.h"

#include <hpvi/driver/load_history.h>
#include <hpvi/plane/deformation.h>
#include <hpvi/reader/checks/rejection.h>
#include <hpvi/results/mean_gradients.h>
#include <hpvi/results/probe_value.h>
#include <hpvi/results/solution_field.h>
#include <hpvi/results/warnings/warnings.h>
#include <hpvi/scene/bare_joints.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

namespace
{
using namespace verification;

std::vector<std::string> warnings_of(const Scene<2> &scene)
{
  std::vector<std::string> result;
  AdaptiveSolver<2>(scene).run([&](const StepReport<2> &step) { result = texts(step.warnings); });
  return result;
}

bool warns(const Scene<2> &scene, const std::string &words)
{
  return mentions(warnings_of(scene), words);
}

TEST(Warnings, BilateralContactThatPulls)
{
  // The left edge pushed up tips the block of Example 5.2: half of its contact is pulled. Pressed
  // down hard enough nothing is.
  const Overrides steps = {given::steps("hup2", "2")};
  EXPECT_TRUE(warns(shipped_scene("han-6-12", with(steps, {{"Boundary left/Traction", "0; 10"}})),
                    "pulls"));
  EXPECT_FALSE(warns(shipped_scene("han-6-12", with(steps, {{"Boundary top/Traction", "0; -50"}})),
                     "pulls"));
}

/** The unit square with @p u on all sides, which is the solution where it is linear. */
Scene<2> deformed_square(const std::string &u, const Overrides &more = {})
{
  Overrides entries = {{"Geometry/Subdivisions", "2, 2"}, {"Adaptivity/Maximum steps", "1"}};
  for (const std::string side : {"left", "right", "bottom", "top"})
    entries.emplace_back("Boundary " + side + "/Displacement", u);
  return scene_of(with(entries, more));
}

TEST(Warnings, StrainsAndRotationsThatAreNotSmall)
{
  const std::string strain = "the strain is ", turn = "the body turns by ";
  EXPECT_FALSE(warns(deformed_square("0; -0.049*y"), strain));
  EXPECT_TRUE(warns(deformed_square("0; -0.051*y"), strain + "5.1 % on average"));
  EXPECT_TRUE(warns(deformed_square("0.12*y; 0"), strain + "6 %")); // along the diagonals
  EXPECT_TRUE(warns(deformed_square("0.06*y + 0.1*x*y; 0"), "cell at (0.75 0.75)"));
  EXPECT_FALSE(warns(deformed_square("-0.08*y; 0.08*x"), turn));
  EXPECT_TRUE(warns(deformed_square("-0.1*y; 0.1*x"), turn + "5.73 degrees"));
  EXPECT_FALSE(warns(deformed_square("-0.1*y; 0.1*x"), strain));
  EXPECT_FALSE(warns(deformed_square("5; 7"), strain)); // only moved
  // A mesh that is refined has the same coarse cells.
  EXPECT_TRUE(warns(deformed_square("0.06*y + 0.1*x*y; 0", {given::steps("hup2", "4")}),
                    "cell at (0.75 0.75)"));
}

/** Unloaded at the end: the largest before counts, with its place. */
/** What is said of the coarse mesh names the entries that make it. */
TEST(Words, OfTheMeshAreThoseOfTheScene)
{
  const auto said = [](const Shape shape, const std::string &message)
  {
    Scene<2> scene;
    scene.geometry.shape = shape;
    return in_entries_of(scene, message);
  };
  const std::string raise = "raise Geometry/Subdivisions or set Geometry/Graded towards there";
  EXPECT_EQ(said(Shape::box, raise), raise);
  EXPECT_EQ(said(Shape::ring_sector, raise), raise);
  EXPECT_EQ(said(Shape::bodies, raise),
            "raise Body NAME/Subdivisions or set Body NAME/Graded towards there");
  EXPECT_EQ(said(Shape::file, raise),
            "take more cells in Geometry/File or set Geometry/Graded towards there");
  EXPECT_EQ(said(Shape::file, "take fewer Geometry/Subdivisions"),
            "take fewer cells in Geometry/File");
  const Overrides flat{{"Body a/Upper corner", "40, 1"},
                       {"Boundary a.bottom/Displacement", "0; 0"},
                       {"Boundary a.top/Pressure", "1e-3"},
                       {"Adaptivity/Maximum steps", "1"}};
  EXPECT_TRUE(warns(scene_of(flat), "take more cells along the body, Body NAME/Subdivisions"));
}

/** Principal values that are equal up to round-off are numbers, and the larger one is the size of the tensor. */
TEST(Warnings, StrainsThatAreEqualInAllDirectionsAreNumbers)
{
  const double e = 1.2e-5 * 20;
  for (const double ulp : {0., 1e-16, -1e-16, 3e-17})
    for (const double shear : {0., 1e-22, -4e-21, 1e-20, 1e-18, 1e-300})
      for (const double size : {1., 1e-8, -300., 1e100, 1e-100})
      {
        MeanGradient<2> gradient{};
        gradient.value =
            Tensor<2, 2>({{size * e, size * shear}, {size * shear, size * e * (1 + ulp)}});
        EXPECT_NEAR(gradient.largest_strain() / std::abs(size * e), 1, 1e-12) << shear;
        FullStress stress;
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = i; j < 2; ++j)
            stress[i][j] = gradient.value[i][j];
        const auto principal = principal_stresses<2>(stress);
        for (unsigned int i = 0; i < 2; ++i)
          EXPECT_NEAR(principal[i] / (size * e), 1, 1e-12) << shear;
        EXPECT_GE(principal[0], principal[1]);
      }
  EXPECT_FALSE(warns(scene_of({given::box("100, 10", "4, 1"),
                               given::elastic("210000", "0"),
                               {"Material/Plane", "stress"},
                               {"Material/Thermal expansion", "12e-6"},
                               {"Temperature/Expression", "20"},
                               {"Boundary left/Displacement", "0; free"},
                               {"Boundary bottom/Symmetry", "true"}}),
                     "the strain is"));
}

TEST(Warnings, StrainsOfPastLoadSteps)
{
  std::vector<std::string> last;
  const std::string strain = "if(t < 0.4, 0.1, if(t < 0.7, 0.2, 0.01))";
  LoadHistory<2>(deformed_square("0; -y*" + strain, {{"Loading/Steps", "3"}}))
      .run([&](const StepReport<2> &step) { last = texts(step.warnings); });
  EXPECT_TRUE(std::any_of(last.begin(), last.end(),
                          [](const std::string &line) {
                            return line.find("the strain is 20 %") == 0 &&
                                   says(line, "load step 2, t = 0.6");
                          }));
}

TEST(Warnings, SlipThatIsLong)
{
  const auto pushed = [](const std::string &u)
  {
    return scene_of({{"Boundary top/Displacement", u + "; free"},
                     given::rough("bottom", "bilateral", "1e-6"),
                     {"Adaptivity/Maximum steps", "1"}});
  };
  EXPECT_FALSE(warns(pushed("0.14"), "the body slides"));
  EXPECT_TRUE(warns(pushed("0.142"), "the body slides by 0.142"));
}

/** "strain", "rotation", "slip", as far as @p warnings speak of them. */
std::string not_small(const std::vector<std::string> &warnings)
{
  std::string result;
  for (const auto &[subject, words] : {std::pair("strain", "the strain is "),
                                       {"rotation", "the body turns by "},
                                       {"slip", "the body slides by "}})
    for (const std::string &warning : warnings)
      if (warning.find(words) == 0)
        result += (result.empty() ? "" : ", ") + std::string(subject);
  return result;
}

/** Those that doc/reliability.md lists, in two steps each. */
TEST(Warnings, ShippedScenesWhoseStrainsAreNotSmallAreListed)
{
  std::map<std::string, std::string> listed, found;
  std::ifstream page("doc/reliability.md");
  const std::regex row(R"(\| `([a-z0-9-]+)` \| ((strain|rotation|slip)[a-z, ]*) \|.*)");
  std::smatch match;
  for (std::string line; std::getline(page, line);)
    if (std::regex_match(line, match, row))
      listed[match[1]] = match[2];
  for (const auto &file : std::filesystem::directory_iterator("prm"))
  {
    const std::string name = file.path().stem().string();
    if (file.path().extension() != ".prm") // a directory of meshes
      continue;
    if (std::set<std::string>{"ball", "block-space", "clamped-plates", "column-base", "dome",
                              "floor-slab", "foot", "fretting-dome", "fretting-pad-space",
                              "growth-rings", "slab", "spheres"}
            .count(name)) // in space
      continue;
    const Scene<2> scene =
        shipped_scene(name, {{"Adaptivity/Maximum steps", "2"}, {"Error/Bound", "false"}});
    std::vector<std::string> last;
    LoadHistory<2>(scene).run([&](const StepReport<2> &step) { last = texts(step.warnings); });
    if (const std::string subjects = not_small(last); !subjects.empty())
      found[name] = subjects;
  }
  EXPECT_EQ(found, listed);
}

TEST(Warnings, MultiplierAboveOneBetweenGaussPoints)
{
  const auto stick_slip =
      [](const std::string &method, const std::string &degree, const std::string &steps)
  {
    return shipped_scene(
        "stick-slip", {given::steps(method, steps, degree), {"Exact solution/Transition", "0.1"}});
  };
  EXPECT_TRUE(warns(stick_slip("pu", "5", "1"), "between Gauss points"));
  EXPECT_FALSE(warns(stick_slip("hpa3", "2", "12"), "between Gauss points"));
}

TEST(Warnings, TransitionOnACoarseEdge)
{
  EXPECT_TRUE(warns(shipped_scene("stick-slip", {{"Adaptivity/Maximum steps", "2"}}),
                    "stick and slip meet"));
  EXPECT_FALSE(warns(shipped_scene("stick-slip", {{"Adaptivity/Maximum steps", "12"}}),
                     "stick and slip meet"));
}

TEST(Warnings, EstimateThatStagnates)
{
  // A step of the traction inside an edge is not resolved by raising p alone.
  EXPECT_TRUE(warns(shipped_scene("han-6-12", {given::steps("pu", "9"),
                                               {"Adaptivity/Maximum degree", "14"},
                                               {"Boundary top/Traction", "if(x<1.3, 0, -100); 0"}}),
                    "stagnates"));
  EXPECT_FALSE(warns(shipped_scene("han-6-12", {{"Adaptivity/Maximum steps", "8"}}), "stagnates"));
}

/** The warning with @p words that a plain solution gets with these estimates and this error. */
std::string warning(const std::string &words, const std::vector<double> &estimates,
                    const AlgebraicError &error = {})
{
  const Scene<2> scene = shipped_scene("han-6-12");
  const RandomMesh mesh(scene, 1, 1);
  const Laboratory discrete(scene, mesh);
  History<2> history;
  for (const double estimate : estimates)
    history.push_back({estimate, 0., 0., 0., false});
  const Solution<2> solution = discrete.solve();
  const auto contact = contact_states(SolutionField(solution));
  for (const std::string &line :
       texts(joined(warnings(scene, contact, body_state(SolutionField(solution)), history),
                    multiplier_warnings(solution, contact, error, {}))))
    if (says(line, words))
      return line;
  return {};
}

/** Three steps in a row, each above 0.9 of the one before. */
TEST(Warnings, StagnationTakesThreeSteps)
{
  for (const std::vector<double> &slow :
       {std::vector<double>{9., 1., 0.95, 0.9, 0.85}, std::vector<double>{1., 0.95, 0.9, 0.85}})
    EXPECT_NE(warning("stagnates", slow).find("1 three steps ago, 0.85 now"), std::string::npos);
  EXPECT_EQ(warning("stagnates", {1., 0.95, 0.9}), "");
  EXPECT_EQ(warning("stagnates", {9., 1., 0.89, 0.88, 0.87}), "");
  EXPECT_EQ(warning("stagnates", {9., 1., 0.95, 0.84, 0.83}), "");
  EXPECT_EQ(warning("stagnates", {9., 1., 0.99, 0.98, 0.87}), "");
}

/** As with a body force that has a pole, whose value at Gauss points grows without bound. */
TEST(Warnings, EstimateThatRises)
{
  EXPECT_EQ(warning("rose", {3., 1., 0.3, 1.1}), "");
  EXPECT_NE(warning("rose", {3., 1., 0.3, 1.3, 0.2}).find("from 0.3 in step 3 to 1.3 in step 4"),
            std::string::npos);
}

TEST(Warnings, DoubtfulDigits)
{
  AlgebraicError error;
  error.relative = 0.9e-6;
  EXPECT_EQ(warning("round-off reaches", {1.}, error), "");
  error.relative = 1.1e-6;
  EXPECT_NE(warning("round-off reaches", {1.}, error), "");
}

TEST(Warnings, ElongatedElements)
{
  const auto bar = [](const std::string &subdivisions)
  {
    return shipped_scene(
        "han-6-13", {{"Geometry/Subdivisions", subdivisions}, {"Adaptivity/Maximum steps", "1"}});
  };
  EXPECT_TRUE(warns(bar("1, 16"), "80 times as long as wide"));
  EXPECT_TRUE(warns(bar("1, 4"), "20 times as long as wide"));
  EXPECT_FALSE(warns(bar("1, 3"), "as long as wide"));
  EXPECT_FALSE(warns(bar("16, 1"), "as long as wide"));
}

TEST(Warnings, LowDegreeNearIncompressibility)
{
  const auto stick_slip = [](const std::string &poisson, const std::string &degree)
  {
    return shipped_scene("stick-slip", {{"Material/Plane", "strain"},
                                        {"Material/Poisson's ratio", poisson},
                                        given::steps("hup2", "1", degree)});
  };
  EXPECT_TRUE(warns(stick_slip("0.4999", "2"), "may lock"));
  EXPECT_FALSE(warns(stick_slip("0.4999", "4"), "may lock"));
  EXPECT_FALSE(warns(stick_slip("0.3", "2"), "may lock"));
}
/** Where g falls to nothing any polynomial is many times g: that is no overshoot worth a word. */
TEST(Warnings, DoNotDivideByABoundThatVanishes)
{
  std::vector<std::string> lines;
  each_step<2>(shipped_scene("han-6-12", {{"Boundary bottom/Friction bound", "4.5*exp(-40*x)"},
                                          {"Adaptivity/Maximum steps", "10"}}),
               [&](const StepReport<2> &step) { lines = texts(step.warnings); });
  for (const std::string &line : lines)
    EXPECT_EQ(line.find("|lambda|"), std::string::npos) << line;
}
/** Half of the edge has no bound; the polynomial through the other half goes on there. */
TEST(Warnings, NameFrictionWhereThereIsNone)
{
  EXPECT_TRUE(
      warns(shipped_scene("han-6-12", {{"Boundary bottom/Friction bound", "if(x < 0.5, 0, 4.5)"},
                                       given::steps("pu", "1", "4")}),
            "where Friction bound is 0"));
}
TEST(Warnings, ABoundOfRoundOffSaysSo)
{
  EXPECT_TRUE(bound_warnings(1.1e-9, 1e-13).empty());
  EXPECT_TRUE(bound_warnings(std::nan(""), 0.).empty());
  EXPECT_TRUE(bound_warnings(1e-14, 1e-15).empty()); // exact to round-off
  const std::string line = bound_warnings(6.3e-11, 1.4e-14).at(0).text;
  EXPECT_NE(line.find("6.3e-11 of the solution"), std::string::npos) << line;
  EXPECT_NE(line.find("1.4e-14 of their stresses"), std::string::npos) << line;
}

TEST(Warnings, OfLoadSteps)
{
  EXPECT_TRUE(load_step_warnings(0.099).empty());
  EXPECT_TRUE(load_step_warnings(std::nan("")).empty());
  EXPECT_NE(load_step_warnings(0.941).at(0).text.find("is 94.1 % of its solution"),
            std::string::npos);
  // A sheared square is rough on one cell, a moved one is exact.
  for (const std::string bottom : {"0; 0", "0.05*t; -0.05*t"})
  {
    std::vector<std::string> lines;
    LoadHistory<2>(scene_of({{"Material/Young's modulus", "1000"},
                             {"Boundary top/Displacement", "0.05*t; -0.05*t"},
                             {"Boundary bottom/Displacement", bottom},
                             {"Adaptivity/Maximum steps", "1"},
                             {"Loading/Steps", "2"}}))
        .run([&](const StepReport<2> &step) { lines = texts(step.warnings); });
    EXPECT_EQ(std::any_of(lines.begin(), lines.end(),
                          [](const std::string &line)
                          { return line.find("the error indicator of a load step is") == 0; }),
              bottom == "0; 0");
  }
}

TEST(Warnings, OfDissipation)
{
  EXPECT_TRUE(dissipation_warnings(0., 0., 0.).empty());
  EXPECT_TRUE(dissipation_warnings(1., 0.951, 2.).empty());
  EXPECT_TRUE(dissipation_warnings(0.951, 1., 2.).empty());
  EXPECT_TRUE(dissipation_warnings(1., 0.5, 1.1e6).empty()); // nobody will miss it
  EXPECT_FALSE(dissipation_warnings(0.949, 1., 2.).empty());
  EXPECT_FALSE(dissipation_warnings(1., -0.1, 2.).empty());
  const std::string line = dissipation_warnings(6.367, 4.836, 4.836).at(0).text;
  EXPECT_NE(line.find("6.37 by its values at the end"), std::string::npos) << line;
  EXPECT_NE(line.find("4.84 by the trapezoidal rule"), std::string::npos) << line;
  EXPECT_NE(line.find("24 % apart"), std::string::npos) << line;
}

/**
 * A square that is pressed down and dragged by @p slip: all of it slides under Coulomb's law, or under a bound. Where friction grows with
 * the slip, as under a pressure that grows with t, the values at the ends of n load steps dissipate 1 + 1/n of what it does.
 */
TEST(Warnings, OfHistoriesWithFewLoadSteps)
{
  struct Row
  {
    std::string law, value, pressure;
    unsigned int steps;
    bool warns;
  };
  for (const Row &row :
       {Row{"coefficient", "0.1", "t", 4, true}, Row{"coefficient", "0.1", "t", 30, false},
        Row{"coefficient", "0.1", "2", 30, false}, Row{"coefficient", "0.1", "2 - t", 2, true},
        Row{"bound", "0.1*t", "1", 4, true}, Row{"bound", "0.1*t", "1", 30, false},
        Row{"bound", "0.1", "1", 2, true}, Row{"bound", "0", "1", 2, false}})
  {
    std::vector<std::string> warnings;
    LoadStep end;
    LoadHistory<2>(scene_of({given::elastic("1000", "0"),
                             {"Boundary top/Displacement", "0.05*t; free"},
                             {"Boundary top/Pressure", row.pressure},
                             {"Boundary bottom/Contact", "unilateral"},
                             {"Boundary bottom/Friction " + row.law, row.value},
                             {"Adaptivity/Maximum steps", "2"},
                             {"Loading/Steps", std::to_string(row.steps)}}))
        .run(
            [&](const StepReport<2> &step)
            {
              warnings = texts(step.warnings);
              end = step.load;
            });
    const bool found = std::any_of(warnings.begin(), warnings.end(),
                                   [](const std::string &warning)
                                   { return warning.find("friction dissipates ") == 0; });
    EXPECT_EQ(found, row.warns) << row.law << ' ' << row.value << ' ' << row.pressure << ' '
                                << row.steps << ": " << end.dissipated << ' ' << end.trapezoidal;
    EXPECT_EQ(found, std::abs(end.dissipated - end.trapezoidal) >
                             0.05 * std::max(end.dissipated, end.trapezoidal) &&
                         end.dissipated > 0);
  }
}

// ---------------------------------------------------------------- contact

/** A unit square whose top is moved by @p displacement onto what lies below; further @p entries. */
Scene<2> pressed_square(const std::string &displacement, const Overrides &entries)
{
  return scene_of(with({{"Boundary top/Displacement", displacement},
                        {"Boundary bottom/Contact", "unilateral"},
                        given::steps("hup3", "1")},
                       entries));
}

/** The foundation has a kink inside the one cell, which degree 3 cannot follow. */
TEST(Warnings, PenetrationWhateverTheFrame)
{
  const Overrides kink = {{"Boundary bottom/Gap", "0.05*abs(x - 0.4)"}};
  for (const std::string normal : {"nodes", "multiplier"})
    for (const std::string shift : {"0", "100"}) // along the foundation
      EXPECT_TRUE(
          warns(pressed_square(shift + "; -0.02", with(kink, {{"Solver/Normal contact", normal}})),
                "penetrates the foundation of bottom"))
          << normal << shift;
  // Turned by 0.5 about the origin and moved, supports and foundation alike.
  EXPECT_TRUE(warns(pressed_square("3 - 0.5*y; 0.5*x - 0.02",
                                   {{"Boundary bottom/Gap", "0.05*abs(x - 0.4) - 0.5*x"}}),
                    "penetrates the foundation of bottom"));
  EXPECT_FALSE(
      warns(pressed_square("0; -0.02", {{"Boundary bottom/Gap", "0.001*x"}}), "penetrates"));
}

/** Points of a bending mode of amplitude 0.3 beside any rigid motion; in space turns about all axes. */
TEST(Deformation, LeavesRigidMotionsAside)
{
  for (const double size : {1e-60, 1., 1e60})
  {
    Deformation<2> plane;
    Deformation<3> space;
    for (const double x : {-1., 0., 1.})
      for (const double y : {-1., 1.})
      {
        const double bend = 0.3 * (x * x - 2. / 3) * 1.5; // 0.15 at the ends, -0.3 in the middle
        plane.add(size * Point<2>(x + 7, y), size * Point<2>(20 - 4 * y, 5 + 4 * x + bend));
        for (const double z : {-1., 1.})
          space.add(size * Point<3>(x, y + 3, z),
                    size * Point<3>(1 - 2 * y + 3 * z, 2 * x - 5 * z + bend, 9 - 3 * x + 5 * y));
      }
    EXPECT_NEAR(plane.largest(), 0.3 * size, 1e-12 * size);
    EXPECT_NEAR(space.largest(), 0.3 * size, 1e-12 * size);
  }
  EXPECT_EQ(Deformation<2>().largest(), 0.);
}

/** Half of it acts where nothing presses: of a bound that follows the pressure, or Coulomb's, nothing does. */
TEST(Warnings, FrictionWithoutContact)
{
  const Overrides fine = {given::steps("hap2", "6")};
  const auto with_friction = [&](const std::string &entry, const std::string &value)
  {
    return pressed_square("0.03; -0.02", with(fine, {{"Boundary bottom/Gap", "0.1*max(0, x - 0.5)"},
                                                     {"Boundary bottom/" + entry, value}}));
  };
  const std::string words = "friction acts where contact is open";
  EXPECT_TRUE(warns(with_friction("Friction bound", "0.005"), words));
  EXPECT_FALSE(warns(with_friction("Friction bound", "0.02*max(0, 0.25 - x)"), words));
  EXPECT_FALSE(warns(with_friction("Friction coefficient", "0.3"), words));
  const auto said = [](const double open, const double all)
  {
    ContactState<3> state;
    state.open_friction = open;
    state.absolute_friction = all;
    const std::vector<std::string> lines = texts(friction_warnings(Scene<3>(), {state}));
    return lines.empty() ? "" : lines.front();
  };
  EXPECT_EQ(said(0.009, 1.), "");
  EXPECT_NE(said(0.011, 1.).find("1.1 % of it"), std::string::npos);
  EXPECT_EQ(said(0., 0.), "");
}

/** On both sides of a vertex, and where edges begin at it or end. */
TEST(Warnings, TransitionOnAVertex)
{
  const Scene<2> scene = shipped_scene("han-6-12");
  const RandomMesh mesh(scene, 1, 0);
  const Laboratory discrete(scene, mesh);
  const Solution<2> solution = discrete.solve();
  std::vector<ContactState<2>> contact = contact_states(SolutionField(solution));
  for (const double x : {0., 1., 1 + 1e-15, 1 - 1e-15, 2., 3., 3.5, 4.})
  {
    contact.at(0).transitions = {Point<2>(x, 0)};
    unsigned int found = 0;
    for (const std::string &line : texts(multiplier_warnings(solution, contact, {}, {})))
      found += line.find("stick and slip meet at (") != std::string::npos &&
               line.find("to +-1 mm only") != std::string::npos;
    EXPECT_EQ(found, 1U) << x;
  }
}

/** Bodies that the drawing has on each other and no pair keeps apart. */
TEST(Warnings, BodiesThatLieOnEachOther)
{
  const auto box = [](const std::string &name, const std::string &lower, const std::string &upper)
  {
    return Overrides{{"Body " + name + "/Lower corner", lower},
                     {"Body " + name + "/Upper corner", upper},
                     {"Body " + name + "/Subdivisions", "2, 1"}};
  };
  const auto ring = [](const std::string &name, const std::string &radii)
  {
    return Overrides{{"Body " + name + "/Shape", "ring sector"},
                     {"Body " + name + "/Radii", radii},
                     {"Body " + name + "/Angles", "0, 90"},
                     {"Body " + name + "/Subdivisions", "1, 3"}};
  };
  const Overrides low =
                      with(box("a", "0, 0", "1, 1"), {{"Boundary a.bottom/Displacement", "0; 0"}}),
                  held = {{"Boundary b.top/Displacement", "0; -0.05"}},
                  pair = {{"Contact joint/Between", "a.top, b.bottom"}};
  struct Row
  {
    std::string name;
    Overrides entries;
    std::vector<std::string> joints;
  };
  const std::vector<Row> rows{
      {"a stack", with(with(low, box("b", "0, 1", "1, 2")), held), {"a.top b.bottom"}},
      {"with a pair", with(with(with(low, box("b", "0, 1", "1, 2")), held), pair), {}},
      {"a hair apart", with(with(low, box("b", "0, 1.0001", "1, 2")), held), {}},
      {"a small one on it",
       with(with(low, box("b", "0.7, 1", "0.72, 1.1")), held),
       {"a.top b.bottom"}},
      {"one that hangs over",
       with(with(low, box("b", "0.9, 1", "5, 2")), held),
       {"a.top b.bottom"}},
      {"at a corner", with(with(low, box("b", "1, 1", "2, 2")), held), {}},
      {"beside each other", with(with(low, box("b", "1, 0", "2, 1")), held), {"a.right b.left"}},
      {"both held",
       with(with(with(low, box("b", "0, 1", "1, 2")), held),
            {{"Boundary a.top/Displacement", "0; 0"}, {"Boundary b.bottom/Symmetry", "true"}}),
       {}},
      {"one of them held",
       with(with(with(low, box("b", "0, 1", "1, 2")), held),
            {{"Boundary a.top/Displacement", "0; 0"}}),
       {"a.top b.bottom"}},
      {"a third one",
       with(with(with(with(low, box("b", "0, 1", "1, 2")), held), pair),
            box("c", "0, 2", "0.5, 3")),
       {"b.top c.bottom"}},
      {"rings",
       with(with(ring("a", "1, 1.5"), ring("b", "1.5, 2")),
            {{"Boundary a.inner/Displacement", "0; 0"}}),
       {"a.outer b.inner"}},
      {"a ring in a wider one", with(ring("a", "1, 1.5"), ring("b", "1.51, 2")), {}},
      {"a ring that stands on a point",
       with(with(low, ring("b", "0.5, 1")),
            {{"Body b/Centre", "0.5, 2"}, {"Body b/Angles", "225, 315"}}),
       {}}};
  for (const Row &row : rows)
  {
    Overrides entries = row.entries;
    for (const std::string body : {"a", "b", "c"}) // whatever else may hold them
      if (std::any_of(entries.begin(), entries.end(),
                      [&](const auto &entry)
                      { return entry.first.rfind("Body " + body + "/", 0) == 0; }))
      {
        const bool is_ring = std::any_of(entries.begin(), entries.end(),
                                         [&](const auto &entry)
                                         { return entry.first == "Body " + body + "/Shape"; });
        entries.emplace_back("Boundary " + body + (is_ring ? ".start" : ".left") + "/Spring",
                             "1; 1");
      }
    const Scene<2> scene = scene_of(entries);
    std::vector<std::string> joints;
    for (const BareJoint<2> &joint : bare_joints(scene))
      joints.push_back(joint.sides[0] + " " + joint.sides[1]);
    EXPECT_EQ(joints, row.joints) << row.name;
  }
  const Overrides one_step{{"Adaptivity/Maximum steps", "1"}};
  const std::string words =
      "a.top and b.bottom lie on each other at (0.75 1) and no Contact names them";
  EXPECT_TRUE(warns(scene_of(with(rows[0].entries, one_step)), words));
  EXPECT_FALSE(warns(scene_of(with(rows[1].entries, one_step)), "lie on each other"));
}

/** A block that is squeezed slips outwards on both sides of its middle. */
TEST(Zones, AreNoTwoAlikeInARow)
{
  const Scene<2> scene = scene_of({{"Boundary top/Displacement", "0; -0.02"},
                                   given::rough("bottom", "bilateral", "1e-5"),
                                   {"Geometry/Subdivisions", "2, 1"},
                                   given::steps("hup3", "1")});
  AdaptiveSolver<2>(scene).run(
      [](const StepReport<2> &step)
      {
        const ContactState<2> &state = step.contact.at(0);
        ASSERT_EQ(state.transitions.size(), 1U); // the slip turns around
        EXPECT_NEAR(state.transitions[0][0], 0.5, 1e-12);
        ASSERT_EQ(state.zones.size(), 1U);
        EXPECT_EQ(state.zones[0].mode, ContactMode::slip);
        EXPECT_NEAR(state.zones[0].begin.distance(state.zones[0].end), 1., 1e-12);
        EXPECT_NEAR(state.absolute_friction, 1e-5, 1e-15);
        EXPECT_NEAR(state.friction_resultant, 0., 1e-15);
        EXPECT_EQ(state.open_friction, 0.);
      });
}
/** Intervals of one number have a number in common; those of others need not. */
TEST(Claims, OfOneNumberMeet)
{
  const std::string J = "the least energy", F = "force x between low.top and up.bottom";
  const auto claim = [](const std::string &what, const double low, const double high,
                        const std::string &where = "in step 2", const double round_off = 1e-9) {
    return Claim{what, where, low, high, round_off};
  };
  struct Case
  {
    Claims earlier, now;
    std::string words; ///< empty: no contradiction
  };
  for (const Case &one : std::vector<Case>{
           {{}, {}, ""},
           {{}, {claim(J, 1, 2)}, ""},
           {{claim(J, 1, 2, "in step 1")}, {claim(J, 2, 3)}, ""},
           {{claim(J, 1, 2, "in step 1")}, {claim(J, 1.2, 1.3)}, ""},
           {{claim(J, 1, 2, "in step 1")}, {claim(F, 3, 4)}, ""},
           {{claim(J, 1, 2, "in step 1")}, {claim(J, 2 + 1.9e-9, 3)}, ""}, // round-off of both
           {{claim(J, 1, 2, "in step 1")}, {claim(J, 2 + 2.1e-9, 3)}, J},
           {{claim(J, 1.9, 1.9, "in step 1", 0.)}, {claim(J, 1.9, 1.9, "in step 2", 0.)}, ""},
           {{claim(J, 0.001531, 0.001908, "in step 1")},
            {claim(J, -0.000373, -0.0002)},
            "the least energy is in [0.001531, 0.001908] in step 1 and in [-0.000373, -0.0002] in "
            "step 2"},
           {{},
            {claim(F, -0.0002715, -0.0002601, "in step 5 on up.bottom"),
             claim(F, -0.0005358, -0.0005294, "in step 5 on low.top")},
            F + " is in [-0.0002715, -0.0002601] in step 5 on up.bottom and in [-0.0005358, "
                "-0.0005294] in step 5 on low.top"},
           // Of several the two that are farthest apart, in round-offs.
           {{claim(J, 1, 2, "in step 1"), claim(J, -2, -1, "in step 2")},
            {claim(J, 3, 4, "in step 3")},
            "the least energy is in [-2, -1] in step 2 and in [3, 4] in step 3"}})
  {
    const std::string words = contradiction(one.earlier, one.now);
    EXPECT_EQ(words.empty(), one.words.empty()) << words;
    EXPECT_EQ(words.rfind(one.words, 0), 0U) << words;
  }
  EXPECT_TRUE(contradiction_warnings("").empty());
  const Warnings warnings = contradiction_warnings(J);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].text.find("please send scene.prm"), std::string::npos);
}
} // namespace
