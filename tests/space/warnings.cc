// SPDX-License-Identifier: LGPL-2.1-or-later
// Each warning that any solution may deserve, on both paths in the plane and in space.
#include "runs.h"

#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/results/warnings/warnings.h>
#include <hpvi/space/load_check.h>

#include <algorithm>

namespace
{
using namespace space;

/** A unit square or cube, solved once with degree 2 unless @p entries say otherwise. */
template <int dim>
Scene<dim> block(const Overrides &entries)
{
  Overrides all{{"Units/Length", ""},
                {"Units/Stress", ""},
                given::box(dim == 2 ? "1, 1" : "1, 1, 1", dim == 2 ? "2, 2" : "2, 2, 2"),
                {"Boundary left/Traction", ""},
                {"Boundary right/Displacement", ""},
                {"Boundary bottom/Contact", "none"},
                {"Boundary bottom/Friction bound", ""},
                {"Solver/Normal contact", "multiplier"},
                given::steps("hup2", "1")};
  all.insert(all.end(), entries.begin(), entries.end());
  return read_scene<dim>(dim == 2 ? "prm/han-6-12.prm" : "prm/slab.prm", all);
}

template <int dim>
Warnings by_primal_path(const Scene<dim> &scene)
{
  Warnings result;
  steps_of<dim>(scene, [&](const StepReport<dim> &step) { result = step.warnings; });
  return result;
}

Warnings by_reduced_path(const Scene<2> &scene)
{
  Warnings result;
  AdaptiveSolver<2>(scene).run([&](const StepReport<2> &step) { result = step.warnings; });
  return result;
}

bool has(const Warnings &warnings, const WarningKind kind, const std::string &words)
{
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const Warning &warning)
                     { return warning.kind == kind && warning.text.find(words) == 0; });
}

/** What differs from block() in the plane and in space, and what is said of it. */
struct Case
{
  WarningKind kind;
  std::string words;
  Overrides plane, space;
};

/** @p u on all sides. */
Overrides moved(const std::string &u, const bool in_space)
{
  Overrides entries;
  for (const std::string side : {"left", "right", "bottom", "top", "front", "back"})
    if (in_space || (side != "front" && side != "back"))
      entries.emplace_back("Boundary " + side + "/Displacement", in_space ? u + "; 0" : u);
  return entries;
}

/** The top is moved to @p top, onto a foundation. */
Overrides pressed(const std::string &top, const Overrides &more, const bool in_space)
{
  Overrides entries{{"Boundary top/Displacement", in_space ? top + "; 0" : top},
                    {"Boundary bottom/Contact", "unilateral"}};
  entries.insert(entries.end(), more.begin(), more.end());
  return entries;
}

Overrides clamped(const Overrides &more, const bool in_space)
{
  Overrides entries{{"Boundary right/Displacement", in_space ? "0; 0; 0" : "0; 0"},
                    {"Boundary left/Traction", in_space ? "1e-3; 0; 0" : "1e-3; 0"}};
  entries.insert(entries.end(), more.begin(), more.end());
  return entries;
}

std::vector<Case> cases()
{
  std::vector<Case> result;
  const auto add = [&](const WarningKind kind, const std::string &words, const auto &entries) {
    result.push_back({kind, words, entries(false), entries(true)});
  };
  add(WarningKind::strain, "the strain is 5.1 % on average",
      [](const bool in_space) { return moved("0; -0.051*y", in_space); });
  add(WarningKind::rotation, "the body turns by 5.73 degrees on average",
      [](const bool in_space) { return moved("-0.1*y; 0.1*x", in_space); });
  add(WarningKind::elongation, "elements up to 20 times as long as wide",
      [](const bool in_space) {
        return clamped({{"Geometry/Subdivisions", in_space ? "1, 20, 1" : "1, 20"}}, in_space);
      });
  add(WarningKind::locking, "Poisson's ratio 0.4999 is near 1/2",
      [](const bool in_space)
      {
        Overrides entries = clamped({{"Material/Poisson's ratio", "0.4999"}}, in_space);
        if (!in_space)
          entries.emplace_back("Material/Plane", "strain");
        return entries;
      });
  add(WarningKind::penetration, "the body penetrates the foundation of bottom by up to 0.0",
      [](const bool in_space) {
        return pressed("0; -0.2", {{"Boundary bottom/Gap", "0.1*abs(x - 0.3)"}}, in_space);
      });
  add(WarningKind::slip, "the body slides by 0.2",
      [](const bool in_space) {
        return pressed("0.2; -0.02", {{"Boundary bottom/Friction bound", "1e-6"}}, in_space);
      });
  add(WarningKind::open_friction, "friction acts where contact is open: ",
      [](const bool in_space)
      {
        return pressed("0.03; -0.02",
                       {{"Boundary bottom/Gap", "0.1*max(0, x - 0.25)"},
                        {"Boundary bottom/Friction bound", "0.05"},
                        {"Geometry/Subdivisions", in_space ? "4, 2, 1" : "4, 2"}},
                       in_space);
      });
  add(WarningKind::tension, "bilateral contact pulls: ",
      [](const bool in_space) {
        return pressed("0; 0.01", {{"Boundary bottom/Contact", "bilateral"}}, in_space);
      });
  add(WarningKind::load, "Traction on left is not resolved near (0 ",
      [](const bool in_space)
      {
        const std::string jump = "if(y < 0.3, 1e-3, 0); 0";
        return clamped({{"Boundary left/Traction", in_space ? jump + "; 0" : jump},
                        {"Geometry/Subdivisions", in_space ? "1, 1, 1" : "1, 1"}},
                       in_space);
      });
  return result;
}

/** By one rule, which cuts no cell: a warning, not silence. */
TEST(Warnings, InSpaceOfHeatThatNoRuleResolves)
{
  const Overrides held{{"Boundary right/Displacement", "0; 0; 0"},
                       {"Geometry/Subdivisions", "1, 1, 1"},
                       {"Material/Thermal expansion", "1e-4"}};
  const std::string words = " is not resolved near (0.5 0.5 0.5): there its stress over a coarse";
  const auto warns = [&](const Overrides &entries, const std::string &begin)
  { return has(by_primal_path(block<3>(held + entries)), WarningKind::load, begin); };
  EXPECT_TRUE(warns({{"Temperature/Expression", "if(x < 0.3, 1, 0)"}}, "Temperature" + words));
  EXPECT_TRUE(warns({{"Material/Initial strain", "if(x*y < 0.2, 1e-3, 0); 0; 0; 0; 0; 0"}},
                    "Initial strain" + words));
  EXPECT_FALSE(warns({{"Temperature/Expression", "1 + x*y*z"}}, ""));
}

/** A load of a kind is integrated once over each coarse cell, on any mesh that came of them. */
TEST(Warnings, InSpaceLoadsAreThoseOfCoarseCells)
{
  for (const char *const force : {"0; 0.2; -1", "0; y*z; -exp(x)"})
  {
    const Scene<3> scene = block<3>({{"Body force/Expression", force},
                                     {"Boundary right/Traction", "1; 0; 0"},
                                     {"Boundary left/Displacement", "0; 0; 0"}});
    Triangulation<3> mesh;
    make_mesh(scene, mesh);
    mesh.refine_global(1);
    const LoadCheck<3> once(scene), refined(scene, mesh);
    EXPECT_EQ(once.in_words(), refined.in_words());
    EXPECT_NEAR(once.sum.force[0], 1, 1e-12);
    EXPECT_LT((once.finer - refined.finer).norm(), 1e-14);
    EXPECT_LT((once.force - once.finer).norm(), 1e-4); // both rules
    EXPECT_EQ(once.worst, refined.worst);
  }
}

TEST(Warnings, InSpaceOfSpringsThatNoRuleResolves)
{
  const auto warns = [](const std::string &springs)
  {
    return has(by_primal_path(block<3>({{"Boundary right/Spring", springs},
                                        {"Geometry/Subdivisions", "1, 1, 1"},
                                        {"Boundary left/Traction", "1e-3; 0; 0"}})),
               WarningKind::load,
               "Spring on right is not resolved near (1 0.5 0.5): there its stiffness on a coarse");
  };
  EXPECT_TRUE(warns("1; if(y < 0.3, 1, 0)"));
  EXPECT_FALSE(warns("1 + y*z; y^2"));
}

TEST(Warnings, StandOnBothPathsInThePlaneAndInSpace)
{
  for (const Case &row : cases())
  {
    const Scene<2> plane = block<2>(row.plane);
    if (row.kind != WarningKind::load) // the reduced path cuts its rules
    {
      EXPECT_TRUE(has(by_reduced_path(plane), row.kind, row.words)) << row.words;
    }
    EXPECT_TRUE(has(by_primal_path(plane), row.kind, row.words)) << row.words;
    EXPECT_TRUE(has(by_primal_path(block<3>(row.space)), row.kind, row.words)) << row.words;
  }
}

TEST(Warnings, DoNotStandWhereNothingAsksForCare)
{
  const std::vector<std::string> none;
  EXPECT_EQ(texts(by_reduced_path(block<2>(clamped({}, false)))), none);
  EXPECT_EQ(texts(by_primal_path(block<2>(clamped({}, false)))), none);
  EXPECT_EQ(texts(by_primal_path(block<3>(clamped({}, true)))), none);
}

/** In space no picture shows it: which sides are open all over, and where they lie. */
TEST(Warnings, OfContactThatTouchesNowhere)
{
  const std::string bottom = "nothing touches: bottom (y = 0) is open all over; check which side",
                    left = "nothing touches: left (x = 0) and bottom (y = 0) are open all over";
  const Overrides on_bottom{{"Boundary bottom/Contact", "unilateral"}};
  const auto more = [&](const Overrides &entries)
  {
    Overrides all = on_bottom;
    all.insert(all.end(), entries.begin(), entries.end());
    return all;
  };
  const std::vector<std::pair<Overrides, std::string>> rows{
      {more({{"Boundary top/Displacement", "0.01; 0.005; -0.02"}}), bottom},
      {more({{"Boundary top/Displacement", "0; 0.005; 0"},
             {"Boundary bottom/Friction coefficient", "0.3"}}),
       bottom},
      {more({{"Boundary top/Displacement", "0; -0.01; 0"}, {"Boundary bottom/Gap", "0.02"}}),
       bottom},
      {more({{"Boundary top/Displacement", "0; 0; 0"}, {"Body force/Expression", "0; 0.01; 0"}}),
       bottom},
      {more({{"Boundary top/Displacement", "0; 0.005; 0"},
             {"Boundary bottom/Friction bound", "0.001"}}),
       bottom},
      {more({{"Boundary top/Displacement", "0.01; 0.01; 0"},
             {"Boundary left/Contact", "unilateral"}}),
       left},
      {more({{"Boundary top/Displacement", "0; -0.005; 0"}}), ""},
      {more({{"Boundary top/Displacement", "0; -0.005; 0"}, {"Boundary bottom/Gap", "x/100"}}), ""},
      {more({{"Boundary top/Displacement", "free; 0.01; 0"},
             {"Boundary right/Traction", "-0.01; 0; 0"},
             {"Boundary left/Contact", "unilateral"}}),
       ""},
      {more({{"Boundary top/Displacement", "free; 0.01; 0"},
             {"Boundary left/Contact", "bilateral"}}),
       ""}};
  for (const auto &[entries, words] : rows)
  {
    SCOPED_TRACE(entries.back().first + " = " + entries.back().second);
    const Warnings found = by_primal_path(block<3>(entries));
    EXPECT_EQ(has(found, WarningKind::no_contact, words), !words.empty());
    EXPECT_EQ(has(found, WarningKind::no_contact, ""), !words.empty());
  }
  // Another load step may reach the foundation.
  Overrides history = more({{"Boundary top/Displacement", "0; 0.01 - 0.02*t; 0"},
                            {"Loading/Steps", "2"},
                            {"Adaptivity/Tolerance", "0"}});
  LoadHistory<3>(block<3>(history))
      .run([&](const StepReport<3> &step)
           { EXPECT_FALSE(has(step.warnings, WarningKind::no_contact, "")); });
}

/** Of steps there is the same to say wherever they were. */
TEST(Warnings, OfTheHistoryInSpace)
{
  const auto said = [](const std::vector<double> &estimates)
  {
    History<3> history;
    for (const double estimate : estimates)
      history.push_back({estimate, 0.});
    const std::vector<std::string> lines = texts(history_warnings(Scene<3>(), history));
    return lines.empty() ? "" : lines.front();
  };
  EXPECT_EQ(said({1., 0.95, 0.9, 0.8}), "");
  EXPECT_NE(said({1., 0.95, 0.9, 0.85}).find("1 three steps ago, 0.85 now"), std::string::npos);
  EXPECT_EQ(said({1., 0.3, 1.1}), "");
  EXPECT_NE(said({1., 0.3, 1.3}).find("from 0.3 in step 2 to 1.3 in step 3"), std::string::npos);
}

/** The worst by its size, whatever numbers stand in its text; lines by kind, not in the order in which they came. */
TEST(Warnings, OfLoadStepsKeepTheWorstOfEachKind)
{
  Warnings worst;
  keep_worst(worst, {{WarningKind::slip, 0.2, "9 slips"}, {WarningKind::strain, 0.1, "strain"}},
             "load step 1");
  keep_worst(worst, {{WarningKind::slip, 0.3, "1 slips"}}, "load step 2");
  keep_worst(worst, {{WarningKind::slip, 0.25, "5 slips"}, {WarningKind::tension, 0., "pulls"}},
             "load step 3");
  EXPECT_EQ(texts(worst), (std::vector<std::string>{"pulls (load step 3)", "strain (load step 1)",
                                                    "1 slips (load step 2)"}));
}
/** Who asks for little is told what is left. */
TEST(Warnings, ForcesThatDoNotBalanceAreNamed)
{
  Scene<3> scene = slab({{"Adaptivity/Maximum steps", "1"},
                         {"Geometry/Subdivisions", "1, 1, 1"},
                         {"Boundary bottom/Contact", "none"},
                         {"Boundary bottom/Friction bound", ""}});
  const auto is_told = [&](const double tolerance)
  {
    scene.solver.primal_tolerance = tolerance;
    return has(by_primal_path(scene), WarningKind::cut_off, "forces are out of balance by ");
  };
  EXPECT_TRUE(is_told(1));
  EXPECT_FALSE(is_told(1e-6));
}
} // namespace
