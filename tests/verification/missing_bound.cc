// SPDX-License-Identifier: LGPL-2.1-or-later
// Steps that have no bound of their error, and why; and steps that once had none.
#include "discretisation.h"

#include <hpvi/base/formatting.h>
#include <hpvi/bound/error_bound.h>
#include <hpvi/output/summary.h>
#include <hpvi/output/tables.h>
#include <hpvi/plane/discretisation.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

namespace
{
using namespace verification;

Overrides body(const std::string &corners, const std::string &subdivisions)
{
  return {given::quadrilateral("Geometry", corners, subdivisions),
          given::elastic("100", "0.3"),
          {"Units/Length", "mm"},
          {"Adaptivity/Tolerance", "0"},
          {"Adaptivity/Method", "hpa3"}};
}

/** What steps say of the least energy, and the relative bound of the last one that has one. */
struct Bounds
{
  double low = -std::numeric_limits<double>::infinity(),
         high = std::numeric_limits<double>::infinity(), last = -1;
};

// ---------------------------------------------------------------- a force in a corner

struct Tip
{
  std::string name;
  Overrides scene;
  unsigned int n_steps; ///< in the last of which no pressure has the moment of the discrete one
};

/** A beam that is held at its left end and bends until its tip touches. */
Overrides beam(const Overrides &more)
{
  return with(body("0, 0; 8, 0; 8, 1; 0, 1", "8, 1"),
              with({{"Boundary left/Displacement", "0; 0"},
                    {"Boundary top/Traction", "0; -0.01"},
                    {"Boundary bottom/Contact", "unilateral"},
                    {"Boundary bottom/Gap", "0.1"}},
                   more));
}

const std::vector<Tip> tips = {
    {"cells_of_one_degree", beam({{"Adaptivity/Method", "hup2"}}), 2},
    {"degree_four", beam({{"Adaptivity/Method", "hap4"}}), 1},
    {"both_h_and_p", beam({}), 2},
    {"friction", beam({{"Boundary bottom/Friction bound", "0.01"}}), 2},
    {"load_at_the_end",
     with(beam({{"Boundary top/Traction", ""}, {"Boundary right/Traction", "0; -0.05"}}),
          body("0, 0; 5, 0; 5, 1; 0, 1", "5, 1")),
     4},
    {"weight",
     with(beam({{"Boundary top/Traction", ""},
                {"Body force/Expression", "0; -0.02"},
                {"Boundary bottom/Gap", "0.02*x"}}),
          body("0, 0; 6, 0; 6, 1; 0, 1", "6, 2")),
     7},
    {"parallelogram", beam({{"Geometry/Corners", "0, 0; 8, 0; 8.4, 1; 0.4, 1"}}), 3},
    {"nearly_incompressible",
     beam({{"Material/Plane", "strain"}, {"Material/Poisson's ratio", "0.4999"}}), 4},
    {"upright",
     with(body("0, 0; 1, 0; 1, 8; 0, 8", "1, 8"), {{"Boundary bottom/Displacement", "0; 0"},
                                                   {"Boundary left/Traction", "0.01; 0"},
                                                   {"Boundary right/Contact", "unilateral"},
                                                   {"Boundary right/Gap", "0.1"}}),
     2},
    {"bent_foundation", beam({{"Boundary bottom/Gap", "0.1 + 0.001*cos(2*x)"}}), 2}};

using TipContact = ::testing::TestWithParam<Tip>;

Bounds run(const Overrides &entries, const unsigned int n_steps)
{
  Bounds result;
  const Scene<2> scene =
      scene_of(with(entries, {{"Adaptivity/Maximum steps", std::to_string(n_steps)}}));
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        EXPECT_TRUE(step.bound) << "step " << step.number << ": " << step.no_bound;
        if (!step.bound)
          return;
        result.low = std::max(result.low, step.energies.energy - step.bound->energy_below);
        result.high = std::min(result.high, step.energies.energy + step.bound->energy_above);
        result.last = step.relative_bound;
      });
  return result;
}

/** Its intervals of energy hold that of many more steps. */
TEST_P(TipContact, HasABoundInEachStep)
{
  const Tip &tip = GetParam();
  const Bounds coarse = run(tip.scene, tip.n_steps),
               fine = run(with(tip.scene, {{"Adaptivity/Method", "hpa3"}}), 8);
  EXPECT_LE(coarse.low, fine.high);
  EXPECT_LE(fine.low, coarse.high);
  EXPECT_LT(coarse.last, 0.3);
  EXPECT_LT(fine.high - fine.low, 1e-3 * std::abs(fine.low));
}

INSTANTIATE_TEST_SUITE_P(, TipContact, ::testing::ValuesIn(tips),
                         [](const auto &info) { return info.param.name; });

// ---------------------------------------------------------------- the reason

struct Reason
{
  std::string name;
  Overrides scene;
  std::string words,
      number; ///< that its last step says, and of what the number between them is a part
};

/** Far from its support a beam hardly strains; cells there that are small lose what little it does. */
const Overrides graded =
    with(body("0, 0; 20, 0; 20, 1; 0, 1", "20, 1"), {given::graded("Geometry", "20, 0", "25"),
                                                     {"Boundary left/Displacement", "0; 0"},
                                                     {"Boundary top/Traction", "0; -1"},
                                                     {"Adaptivity/Maximum steps", "1"}});

const Overrides held =
    with(body("0, 0; 1, 0; 1, 1; 0, 1", "2, 2"),
         {{"Boundary bottom/Displacement", "0; 0"}, {"Adaptivity/Maximum steps", "1"}});

const std::vector<Reason> reasons = {
    {"round_off", graded, "patches of cells are out of balance by up to ", " of their stresses"},
    {"displacement",
     with(held, {{"Boundary top/Displacement", "0; -0.01*exp(-((x - 0.37)/0.001)^2)"}}),
     "a prescribed displacement or gap is not smooth along the edge at (0.3", " mm"},
    {"load", with(held, {{"Boundary top/Traction", "0; sin(1e5*x*x)"}}),
     "traction on top is not resolved near (", " of all loads"},
    {"springs",
     with(held,
          {{"Boundary right/Traction", "1; 0"}, {"Boundary top/Spring", "2 + sin(1e5*x*x); 0"}}),
     "spring on top is not resolved near (", " of all springs"},
    {"initial_strain",
     with(held, {{"Material/Initial strain", "if(x > 0.2 + 0.7*y, 0.01, 0); 0; 0"}}),
     "initial strain is not resolved near (", " of all stresses of initial strains"}};

using AnyReason = ::testing::TestWithParam<Reason>;

TEST_P(AnyReason, IsSaidWithTheNumber)
{
  const Reason &reason = GetParam();
  each_step<2>(scene_of(reason.scene),
               [&](const StepReport<2> &step)
               {
                 EXPECT_FALSE(step.bound);
                 EXPECT_EQ(step.no_bound.find(reason.words), 0U) << step.no_bound;
                 const std::size_t end = step.no_bound.find(reason.number);
                 ASSERT_NE(end, std::string::npos) << step.no_bound;
                 const std::size_t begin = step.no_bound.rfind(' ', end - 1) + 1;
                 const double number = std::stod(step.no_bound.substr(begin, end - begin));
                 EXPECT_GT(number, 1e-9);
                 EXPECT_LT(number, 1.);
               });
}

/** Stresses there know the pieces of a body force, and none of an initial strain. */
TEST(MissingBound, IsSaidWhereStrainsAreCutInCellsThatAreNoParallelograms)
{
  for (const auto &[entry, value] :
       Overrides{{"Body force/Expression", "if(y > 0.37, 1, 0); 0"},
                 {"Material/Initial strain", "if(y > 0.37, 0.01, 0); 0; 0"}})
    each_step<2>(scene_of(with(body("0, 0; 2, 0; 1.5, 1; 0.5, 1", "1, 1"),
                               {{"Boundary bottom/Displacement", "0; 0"},
                                {entry, value},
                                {"Error/Bound", "true"},
                                {"Adaptivity/Maximum steps", "1"}})),
                 [&, is_force = entry.find("Body") == 0](const StepReport<2> &step)
                 {
                   EXPECT_EQ(bool(step.bound), is_force) << step.no_bound;
                   if (is_force)
                     return;
                   EXPECT_EQ(step.no_bound.find("Initial strain"), 0U) << step.no_bound;
                   EXPECT_NE(step.no_bound.find("is cut inside the cell at ("), std::string::npos)
                       << step.no_bound;
                 });
}

TEST(MissingBound, KeepsItsImbalance)
{
  each_step<2>(
      scene_of(graded),
      [&](const StepReport<2> &step)
      {
        EXPECT_GT(step.bound_imbalance, 1e-9);
        EXPECT_NE(step.no_bound.find(
                      hpvi::text(step.bound_imbalance, 2) +
                      " of their stresses, at (20, 0): round-off, in cells of 1.5e-09 of the body"),
                  std::string::npos)
            << step.no_bound;
      });
}

/** What is out of balance by little leaves an estimate, and no smaller radius about a stress half-way. */
TEST(MissingBound, LeavesNoRadiusInAnEstimate)
{
  last_step<2>(scene_of(with(graded, {{"Error/Bound", "false"}})),
               [](const StepReport<2> &step)
               {
                 const Solution<2> &solution = step.solution();
                 CondensedElements<2> elements(step.scene, solution.tables);
                 const Discretisation<2> discretisation(step.scene, solution.spaces, elements);
                 const ErrorBound bound = ErrorBounds().compute(
                     solution, discretisation,
                     std::make_unique<LinearSolver>(discretisation.factor()), 0.);
                 EXPECT_EQ(bound.flaw, "");
                 EXPECT_EQ(bound.kind, BoundKind::estimate);
                 EXPECT_EQ(bound.radius, bound.total);
                 EXPECT_EQ(bound.theta, 0.);
               });
}

/** A step without a bound after one that has it. */
TEST(MissingBound, LeavesTheLastOneInTheSummary)
{
  Summary summary;
  const auto add = [&](const Overrides &entries)
  {
    const Scene<2> scene = scene_of(entries);
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          Tables<2> tables;
          tables.add(step);
          summary.add(step, tables.convergence.last);
        });
    return summary.json(scene, {});
  };
  const std::string before = add(with(graded, {{"Geometry/Grading levels", "0"}}));
  EXPECT_NE(before.find("\"no_error_bound\": null"), std::string::npos);
  const std::string known = summary.last_error_bound;
  EXPECT_NE(known.find("\"step\": 1,"), std::string::npos) << known;
  EXPECT_NE(before.find("\"error_bound\": " + known), std::string::npos);
  const std::string after = add(graded);
  EXPECT_NE(after.find("\"error_bound\": null"), std::string::npos);
  EXPECT_NE(after.find("\"no_error_bound\": \"patches of cells"), std::string::npos);
  EXPECT_NE(after.find("\"last_error_bound\": " + known), std::string::npos) << after;
}

INSTANTIATE_TEST_SUITE_P(, AnyReason, ::testing::ValuesIn(reasons),
                         [](const auto &info) { return info.param.name; });

/** The body is linear: a bump between all nodes, too small to leave no bound, is the error, and in proportion to a large one. */
TEST(SmallBump, BetweenTheNodesCounts)
{
  const auto scene = [](const std::string &displacement, const Overrides &more)
  {
    return scene_of(with(with(held, {{"Boundary top/Displacement", displacement},
                                     {"Geometry/Subdivisions", "1, 1"}}),
                         more));
  };
  const std::string bump = "exp(-((x - 0.37)/0.02)^2)";
  double norm = 0;
  each_step<2>(scene("0; 1e-3*" + bump, {{"Adaptivity/Maximum steps", "9"}}),
               [&](const StepReport<2> &step) { norm = step.energies.norm; });
  each_step<2>(scene("0; -0.01 + 5e-11*" + bump, {}),
               [&](const StepReport<2> &step)
               {
                 ASSERT_TRUE(step.bound) << step.no_bound;
                 EXPECT_GT(step.bound->data, 5e-8 * norm);
                 EXPECT_LT(step.bound->data, 50 * 5e-8 * norm);
               });
}
/**
 * Three cells around the middle of a hexagon, held at one edge and pulled at the opposite one, with contact beside it: what is
 * along xi for one of them is along eta for its neighbour. Rhombi, or cells that are no parallelograms.
 */
Scene<2> hexagon(const Tensor<1, 2> &shift, const Overrides &entries)
{
  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("hpvi-" + std::to_string(std::random_device()()) + ".msh");
  std::ofstream mesh(file);
  mesh << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"foot\"\n1 2 \"head\"\n"
          "1 3 \"floor\"\n$EndPhysicalNames\n$Nodes\n7\n";
  for (unsigned int k = 0; k < 6; ++k)
    mesh << k + 1 << ' ' << std::cos(k * numbers::PI / 3) << ' ' << std::sin(k * numbers::PI / 3)
         << " 0\n";
  mesh << "7 " << shift[0] << ' ' << shift[1] << " 0\n$EndNodes\n$Elements\n6\n"
       << "1 1 2 1 1 1 2\n2 1 2 2 2 4 5\n3 1 2 3 3 5 6\n"
       << "4 3 2 9 9 7 1 2 3\n5 3 2 9 9 7 3 4 5\n6 3 2 9 9 7 5 6 1\n$EndElements\n";
  mesh.close();
  const Scene<2> scene = scene_of(with({{"Geometry/Shape", "file"},
                                        {"Geometry/File", file.string()},
                                        given::elastic("10", "0.3"),
                                        {"Error/Bound", "true"},
                                        {"Boundary foot/Displacement", "0; 0"},
                                        {"Boundary head/Traction", "-1; -1"},
                                        given::rough("floor", "bilateral", "0.1"),
                                        {"Adaptivity/Tolerance", "0"}},
                                       entries));
  std::filesystem::remove(file);
  return scene;
}

TEST(MeshOfAFile, HasABoundWhereCellsTurn)
{
  for (const auto &shift : {Tensor<1, 2>(), Tensor<1, 2>({0.11, 0.07})})
  {
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::pair<double, double>> energies; // of each step, with the bound
    for (const auto &[method, steps] : {std::pair("pu", "6"), std::pair("hpa3", "9")})
      each_step<2>(hexagon(shift, {given::steps(method, steps, "2")}),
                   [&](const StepReport<2> &step)
                   {
                     ASSERT_TRUE(step.bound) << step.no_bound;
                     EXPECT_LT(step.bound_imbalance, 1e-9);
                     EXPECT_LT(step.bound->total, step.scaled_estimate) << method << step.number;
                     energies.emplace_back(step.energies.energy, step.bound->total);
                     least = std::min(least, step.energies.energy);
                   });
    ASSERT_EQ(energies.size(), 15U);
    for (const auto &[energy, bound] : energies)
      EXPECT_GE(bound, std::sqrt(2 * (energy - least)));
  }
}
} // namespace
