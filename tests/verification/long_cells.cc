// SPDX-License-Identifier: LGPL-2.1-or-later
// The bound of the error on cells that are many times as long as wide: is there one, is it above the error, how near is
// it, and is it the same in each frame?
#include "discretisation.h"

#include <hpvi/bound/vertex_patches.h>

namespace
{
using namespace verification;

/** The energies, bounds and norms of uniform steps. */
struct Step
{
  double energy, bound, norm, imbalance;
};

std::vector<Step> steps_of(const Scene<2> &scene)
{
  std::vector<Step> result;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        EXPECT_TRUE(step.bound) << step.no_bound;
        if (!step.bound)
          return;
        result.push_back(
            {step.energies.energy, step.bound->total, step.energies.norm, step.bound->imbalance});
      });
  return result;
}

struct Body
{
  std::string name, upper_corner, corners, held, loaded, value;
};

const Body cantilever{"cantilever", "200, 1", "", "left", "top/Traction", "0; -1"},
    block{"block", "1, 1", "", "bottom", "top/Traction", "0; -1 - x"},
    drawn{"drawn", "1, 1", "", "bottom", "top/Displacement", "0.1; x"},
    rhombus{"rhombus",
            "",
            "0, 0; 1, 0; 1.984807753, 0.173648178; 0.984807753, 0.173648178",
            "bottom",
            "top/Traction",
            "0.3; -1"};

Scene<2> problem(const Body &body, const std::string &subdivisions, const std::string &degree,
                 const std::string &steps, const Overrides &more = {})
{
  Overrides entries = {{"Geometry/Subdivisions", subdivisions},
                       {"Boundary " + body.held + "/Displacement", "0; 0"},
                       {"Boundary " + body.loaded, body.value},
                       given::steps("hup2", steps, degree),
                       {"Adaptivity/Tolerance", "0"}};
  if (body.corners.empty())
    entries.emplace_back("Geometry/Upper corner", body.upper_corner);
  else
  {
    entries.emplace_back("Geometry/Shape", "quadrilateral");
    entries.emplace_back("Geometry/Corners", body.corners);
  }
  entries.insert(entries.end(), more.begin(), more.end());
  return scene_of(entries);
}

using Length = ::testing::TestWithParam<unsigned int>;

TEST_P(Length, LeavesABound)
{
  const std::string n = std::to_string(GetParam());
  for (const std::string p : {"2", "4"})
  {
    SCOPED_TRACE("p = " + p);
    Body beam = cantilever;
    beam.upper_corner = n + ", 1";
    for (const Scene<2> &scene : {problem(block, "1, " + n, p, "2"), problem(beam, "1, 1", p, "2")})
    {
      const std::vector<Step> steps = steps_of(scene);
      EXPECT_EQ(steps.size(), 2U);
      for (const Step &step : steps)
        EXPECT_LE(step.imbalance, 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, Length, ::testing::Values(60, 200, 1000));

struct Loose
{
  Body body;
  std::string subdivisions, reference;
  double limit; ///< of bound/error
};

using LongCells = ::testing::TestWithParam<Loose>;

/** The energies of a finer mesh tell the error, by Galerkin's orthogonality: a little too small. */
TEST_P(LongCells, HaveABoundAboveTheErrorAndNear)
{
  const auto &[body, subdivisions, reference, limit] = GetParam();
  const Scene<2> finer = problem(body, reference, "4", "12", {{"Adaptivity/Method", "hpa3"}});
  double least = 0;
  for (const Step &step : steps_of(finer))
    least = step.energy;
  for (const std::string p : {"2", "4", "6"})
    for (const Step &step : steps_of(problem(body, subdivisions, p, "2")))
    {
      SCOPED_TRACE("p = " + p);
      const double error = std::sqrt(2 * (step.energy - least));
      EXPECT_GT(error, 1e-3 * step.norm);
      EXPECT_GE(step.bound, error);
      EXPECT_LE(step.bound, limit * error);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, LongCells,
    ::testing::Values(Loose{cantilever, "4, 1", "100, 1", 1.1}, Loose{block, "2, 100", "4, 4", 1.8},
                      Loose{drawn, "2, 100", "4, 4", 1.8}, Loose{rhombus, "2, 2", "4, 4", 1.5}),
    [](const ::testing::TestParamInfo<Loose> &info) { return info.param.body.name; });

/** Turned by 90 degrees, and mirrored. */
TEST(LongCellsInAnotherFrame, HaveTheSameBound)
{
  const Body upright{"upright", "1, 200", "", "bottom", "left/Traction", "1; 0"};
  const auto expected = steps_of(problem(cantilever, "4, 1", "4", "2")),
             turned = steps_of(problem(upright, "1, 4", "4", "2"));
  Body mirrored = cantilever;
  mirrored.held = "right";
  const auto reflected = steps_of(problem(mirrored, "4, 1", "4", "2"));
  ASSERT_EQ(expected.size(), 2U);
  for (unsigned int step = 0; step < 2; ++step)
  {
    EXPECT_NEAR(turned[step].bound, expected[step].bound, 1e-6 * expected[step].bound);
    EXPECT_NEAR(reflected[step].bound, expected[step].bound, 1e-6 * expected[step].bound);
  }
}

/** By the stretches of their map: 4 : 1 is not long in any frame, and a rhombus of 28 degrees is. */
TEST(LongCellsAre, MoreThanFourTimesAsLongAsWide)
{
  const auto are_long = [](const std::string &corners)
  {
    const Scene<2> scene = scene_of(
        {given::quadrilateral("Geometry", corners), {"Boundary left/Displacement", "0; 0"}});
    const RandomMesh mesh(scene, 1, 1, 2, 2);
    return has_long_cells(Laboratory(scene, mesh).solve());
  };
  EXPECT_FALSE(are_long("0, 0; 4, 0; 4, 1; 0, 1"));
  EXPECT_FALSE(are_long("0, 0; 1, 0; 1, 4; 0, 4"));
  EXPECT_FALSE(are_long("0, 0; 2.4, 3.2; 1.6, 3.8; -0.8, 0.6"));
  EXPECT_TRUE(are_long("0, 0; 4.01, 0; 4.01, 1; 0, 1"));
  EXPECT_TRUE(are_long("0, 0; 1, 0; 1, 4.01; 0, 4.01"));
  EXPECT_TRUE(are_long("0, 0; 1, 0; 1.883, 0.469; 0.883, 0.469"));
  EXPECT_FALSE(are_long("0, 0; 1, 0; 1.866, 0.5; 0.866, 0.5"));
}

/** Of cells of triangles, too. */
TEST(LongCellsThatAreDistorted, HaveABoundAboveTheError)
{
  const Body trapezoid{"trapezoid",    "",     "0, 0; 40, 0; 40, 1; 0, 1.5", "left",
                       "top/Traction", "0; -1"};
  double least = 0;
  const Scene<2> finer = problem(trapezoid, "40, 1", "6", "2", {{"Error/Bound", "false"}});
  AdaptiveSolver<2>(finer).run([&](const StepReport<2> &step) { least = step.energies.energy; });
  for (const Step &step : steps_of(problem(trapezoid, "2, 1", "3", "2", {{"Error/Bound", "true"}})))
  {
    const double error = std::sqrt(2 * (step.energy - least));
    EXPECT_GE(step.bound, error);
    EXPECT_LE(step.bound, 1.5 * error);
  }
}

/** High degrees in some cells: the factorisation keeps enough digits of the energy beside its conditions. */
TEST(LongCellsOfManyDegrees, HaveABoundInEachStep)
{
  EXPECT_EQ(
      steps_of(scene_of({given::quadrilateral("Geometry",
                                              "0, 0; 1.876, 0; 1.887, 0.009; 0.011, 0.009", "3, 2"),
                         {"Material/Young's modulus", "0.1"},
                         given::rough("bottom", "bilateral", "0.0018"),
                         {"Boundary right/Displacement", "1.3*y; -0.6*y*exp(-110*y)"},
                         given::steps("hpa2", "6"),
                         {"Adaptivity/Indicator", "residual"},
                         {"Error/Bound", "true"}}))
          .size(),
      6u);
}
} // namespace
