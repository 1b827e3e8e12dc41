// SPDX-License-Identifier: LGPL-2.1-or-later
// Bolts that are tightened: their force is found, then their shortening stays.
#include "discretisation.h"

#include <hpvi/driver/load_history.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

namespace
{
using namespace verification;

/** What a step says of forces. */
struct Forces
{
  std::map<std::string, double> tension, half_width,
      seat; ///< of cuts by name; normal ones of contact
  std::vector<double> shortening;
  Vector<double> u;
};

Forces forces_of(const StepReport<2> &step)
{
  Forces result;
  for (const Resultant<2> &row : step.forces)
    if (row.kind == ForceKind::pretension)
    {
      result.tension[row.name] = row.normal.value;
      if (row.normal.interval)
        result.half_width[row.name] = row.normal.interval->half_width;
    }
    else if (row.kind == ForceKind::contact)
      result.seat[row.name] = row.normal.value;
  for (const Pretension<2> &cut : step.scene.pretensions)
    result.shortening.push_back(cut.shortening);
  result.u = step.solution().u;
  return result;
}

/** Of the last step of each load step. */
std::vector<Forces> history_of(const Scene<2> &scene)
{
  std::vector<Forces> result;
  LoadHistory<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        if (!step.stopped_by.empty())
          result.push_back(forces_of(step));
      });
  return result;
}

Forces last_of(const Scene<2> &scene)
{
  Forces result;
  last_step<2>(scene, [&](const StepReport<2> &step) { result = forces_of(step); });
  return result;
}

/**
 * Two bolts of one body on a foundation: a beam, held down at both ends by legs that are tightened, and pressed to the ground
 * between them. No two of them have the same stiffness.
 */
Overrides clamp(const Overrides &more)
{
  return Overrides{{"Body beam/Lower corner", "0, 3"},
                   {"Body beam/Upper corner", "6, 4"},
                   {"Body beam/Subdivisions", "6, 1"},
                   {"Body left leg/Upper corner", "1, 3"},
                   {"Body left leg/Subdivisions", "1, 2"},
                   {"Body right leg/Lower corner", "5, 0"},
                   {"Body right leg/Upper corner", "6, 3"},
                   {"Body right leg/Subdivisions", "1, 2"},
                   {"Body block/Lower corner", "2, 0"},
                   {"Body block/Upper corner", "4, 3"},
                   {"Body block/Subdivisions", "2, 2"},
                   {"Contact one/Between", "left leg.top, beam.bottom"},
                   {"Contact one/Law", "tied"},
                   {"Contact two/Between", "right leg.top, beam.bottom"},
                   {"Contact two/Law", "tied"},
                   {"Contact seat/Between", "block.top, beam.bottom"},
                   {"Boundary left leg.bottom/Displacement", "0; 0"},
                   {"Boundary right leg.bottom/Displacement", "0; 0"},
                   {"Boundary block.bottom/Displacement", "0; 0"},
                   {"Material/Young's modulus", "1000"},
                   {"Material soft/Young's modulus", "400"},
                   {"Body right leg/Material", "soft"},
                   {"Pretension left/Through", "1, 1; 0, 1"},
                   {"Pretension left/Force", "5"},
                   {"Pretension right/Through", "6, 2; 5, 2"},
                   {"Pretension right/Force", "3"},
                   {"Adaptivity/Method", "hup2"},
                   {"Adaptivity/Start degree", "3"},
                   {"Adaptivity/Maximum steps", "1"}} +
         more;
}

TEST(Pretension, OfTwoBoltsIsFoundTogether)
{
  for (const char *const law : {"unilateral", "bilateral"})
    for (const char *const thickness : {"1", "2.5"})
    {
      const Forces forces =
          last_of(scene_of(clamp({{"Contact seat/Law", law}, {"Material/Thickness", thickness}})));
      EXPECT_NEAR(forces.tension.at("left"), 5, 5e-10);
      EXPECT_NEAR(forces.tension.at("right"), 3, 3e-10);
      EXPECT_NEAR(forces.seat.at("block.top"), -8, 1e-7) << "statics";
      EXPECT_GT(forces.shortening[0], 0);
      EXPECT_GT(forces.shortening[1], 0);
    }
}

/** Betti's theorem: as much as one bolt needs more for a unit of force in the other, the other needs for a unit in it. */
TEST(Pretension, IsReciprocalWhereTheJointIsClosed)
{
  const auto shortening = [](const char *const left, const char *const right)
  {
    return last_of(scene_of(clamp({{"Contact seat/Law", "bilateral"},
                                   {"Pretension left/Force", left},
                                   {"Pretension right/Force", right}})))
        .shortening;
  };
  const std::vector<double> base = shortening("5", "3"), more_left = shortening("6", "3"),
                            more_right = shortening("5", "4");
  EXPECT_NEAR(more_left[1] - base[1], more_right[0] - base[0], 1e-9 * base[0]);
  EXPECT_GT(std::abs(more_right[0] - base[0]), 1e-3 * base[0]);
}

/** By superposition: what is linear in shortenings and loads, by three problems of which none is searched. */
TEST(Pretension, AddsUpWhereTheJointIsClosed)
{
  const auto loaded = [](const std::string &load)
  {
    return clamp({{"Contact seat/Law", "bilateral"}, {"Boundary beam.top/Traction", "0; " + load}});
  };
  const Scene<2> whole = scene_of(loaded("1.5*(2*t - 1)") + Overrides{{"Loading/Steps", "2"}});
  const std::vector<Forces> forces = history_of(whole);
  ASSERT_EQ(forces.size(), 2U);
  EXPECT_EQ(forces[0].shortening, forces[1].shortening);
  Scene<2> load_alone = scene_of(loaded("1.5"));
  for (Pretension<2> &cut : load_alone.pretensions)
    cut.is_fixed = true;
  const Forces share = last_of(load_alone);
  for (const char *const bolt : {"left", "right"})
  {
    EXPECT_NEAR(forces[1].tension.at(bolt), forces[0].tension.at(bolt) + share.tension.at(bolt),
                1e-9);
    EXPECT_GT(share.tension.at(bolt), 0);
  }
  EXPECT_NEAR(forces[1].seat.at("block.top"),
              forces[0].seat.at("block.top") + share.seat.at("block.top"), 1e-7);
}

/** Then the bolts carry the load alone. */
TEST(Pretension, IsTheLoadWhereTheJointIsOpen)
{
  const Scene<2> scene =
      scene_of(clamp({{"Boundary beam.top/Traction", "0; 4*(2*t - 1)"}, {"Loading/Steps", "2"}}));
  const std::vector<Forces> forces = history_of(scene);
  ASSERT_EQ(forces.size(), 2U);
  EXPECT_NEAR(forces[1].seat.at("block.top"), 0, 1e-9);
  EXPECT_NEAR(forces[1].tension.at("left") + forces[1].tension.at("right"), 24, 24e-10);
}

/** The shortening of a step is not that of the next one: each has its own exact force, within its interval. */
TEST(Pretension, HasAnInterval)
{
  const auto scene = [](const char *const method, const char *const steps)
  {
    return scene_of(clamp({{"Adaptivity/Method", method},
                           {"Adaptivity/Maximum steps", steps},
                           {"Adaptivity/Tolerance", "0"},
                           {"Error/Bound", "true"}}));
  };
  each_step<2>(scene("hpa3", "3"),
               [&](const StepReport<2> &step)
               {
                 ASSERT_TRUE(step.bound) << step.no_bound;
                 const Forces coarse = forces_of(step);
                 Scene<2> fine = scene("hpa3", "7");
                 for (unsigned int k = 0; k < 2; ++k)
                 {
                   fine.pretensions[k].is_fixed = true;
                   set_shortening(fine, k, coarse.shortening[k]);
                 }
                 const Forces exact = last_of(fine);
                 for (const char *const bolt : {"left", "right"})
                   EXPECT_LE(std::abs(exact.tension.at(bolt) - coarse.tension.at(bolt)),
                             coarse.half_width.at(bolt) + exact.half_width.at(bolt));
               });
}

/** By statics, with friction below the head or without: what the flange does not press on the joint is the load. */
TEST(Pretension, OfAFlangeIsJointAndLoad)
{
  const double load = 24 * numbers::PI * (47. * 47 - 38 * 38);
  for (const char *const coefficient : {"", "0.15"})
  {
    const std::vector<Forces> forces = history_of(
        shipped_scene("bolted-flange", {{"Contact seat/Friction coefficient", coefficient},
                                        {"Adaptivity/Maximum steps", "2"}}));
    ASSERT_EQ(forces.size(), 5U);
    EXPECT_NEAR(forces.front().tension.at("bolt"), 60000, 6e-6);
    EXPECT_NEAR(forces.front().seat.at("flange.bottom"), -60000, 1e-3);
    EXPECT_NEAR(forces.back().tension.at("bolt"), load - forces.back().seat.at("flange.bottom"),
                1e-3);
    EXPECT_EQ(forces.front().shortening, forces.back().shortening);
    EXPECT_LT(forces[1].tension.at("bolt") - 60000, 0.25 * load / 4) << "the joint is closed";
  }
}

/** To the last bit, for slopes that the search has learnt go along. */
TEST(Pretension, IsTheSameAfterABreak)
{
  const auto scene = [](const char *const steps)
  {
    return scene_of(clamp({{"Adaptivity/Method", "hpa3"},
                           {"Adaptivity/Maximum steps", steps},
                           {"Adaptivity/Tolerance", "0"},
                           {"Error/Bound", "false"}}));
  };
  const Forces whole = last_of(scene("4"));
  const Scene<2> begun = scene("2"), rest = scene("4");
  std::ostringstream out;
  AdaptiveSolver<2> solver(begun);
  solver.run(
      [&](const StepReport<2> &step)
      {
        if (!step.stopped_by.empty())
          solver.state().write(out);
      });
  std::istringstream in(out.str());
  Forces last;
  AdaptiveSolver<2>(rest, RunState<2>::read(in, "state.dat"))
      .run(
          [&](const StepReport<2> &step)
          {
            if (!step.stopped_by.empty())
              last = forces_of(step);
          });
  EXPECT_EQ(last.shortening, whole.shortening);
  EXPECT_EQ(last.u, whole.u);
}

/** What no shortening can do is said, with numbers. */
TEST(Pretension, GivesUpWhereNothingHoldsTheBolt)
{
  const std::string line =
      failure_of(scene_of(clamp({{"Boundary left leg.bottom/Displacement", "0; free"},
                                 {"Boundary block.bottom/Displacement", "0; 0"}})));
  EXPECT_TRUE(says(line, "Pretension left")) << line;
}

TEST(Pretension, GivesUpWhereTwoCutsAskOneBoltForTwoForces)
{
  const std::string line = failure_of(scene_of(
      clamp({{"Pretension right/Through", "1, 2; 0, 2"}, {"Body left leg/Subdivisions", "1, 3"}})));
  EXPECT_TRUE(says(line, "that no other Pretension cuts it")) << line;
}

/** A bar between walls, of three cells: delta = F l/(E A), whichever of its cells is the layer. */
TEST(Pretension, IsThatOfABarFromAFile)
{
  const auto file = std::filesystem::path(::testing::TempDir()) / "hpvi-bar.msh";
  std::ofstream(file) << R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "left"
1 2 "right"
$EndPhysicalNames
$Nodes
8
1 0 0 0
2 0.5 0 0
3 1.2 0 0
4 2 0 0
5 0 1 0
6 0.5 1 0
7 1.4 1 0
8 2 1 0
$EndNodes
$Elements
5
1 1 2 1 1 5 1
2 1 2 2 2 4 8
3 3 2 1 1 1 2 6 5
4 3 2 1 1 2 3 7 6
5 3 2 1 1 3 4 8 7
$EndElements
)";
  const auto bar = [&](const char *const through)
  {
    return scene_of({{"Geometry/Shape", "file"},
                     {"Geometry/File", file.string()},
                     {"Boundary left/Displacement", "0; 0"},
                     {"Boundary right/Symmetry", "true"},
                     {"Material/Young's modulus", "10"},
                     {"Material/Poisson's ratio", "0"},
                     {"Pretension bar/Through", through},
                     {"Pretension bar/Force", "3"},
                     {"Adaptivity/Method", "hup2"},
                     {"Adaptivity/Maximum steps", "2"}});
  };
  for (const char *const through : {"0.5, 0; 0.5, 1", "0.5, 1; 0.5, 0"}) // one cell beside it, two
  {
    const Forces forces = last_of(bar(through));
    EXPECT_NEAR(forces.tension.at("bar"), 3, 3e-10);
    EXPECT_NEAR(forces.shortening[0], 0.6, 1e-9);
  }
  const std::string line = ::failure_of<InputError>([&] { bar("1.2, 0; 1.4, 1"); });
  EXPECT_TRUE(says(line, "has Displacement of Boundary left beside it, at (0, 0.5)")) << line;
}

TEST(Pretension, HasNoCurvedCellBesideIt)
{
  const std::string line = ::failure_of<InputError>(
      []
      {
        scene_of({{"Geometry/Shape", "ring sector"},
                  {"Geometry/Radii", "1, 2"},
                  {"Geometry/Angles", "0, 180"},
                  {"Geometry/Subdivisions", "1, 4"},
                  {"Boundary start/Displacement", "0; 0"},
                  {"Boundary end/Displacement", "0; 0"},
                  {"Pretension ring/Through", "0, 1; 0, 2"},
                  {"Pretension ring/Force", "1"}});
      });
  EXPECT_TRUE(says(line, "has a cell with a curved edge beside it, at ")) << line;
}
} // namespace
