// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies in space that have degrees of their own.
#include "curved_bodies.h"
#include "runs.h"

namespace
{
using namespace space;

Grid block(const double low, const double high, const std::array<unsigned int, 3> &n)
{
  return {n, [=](const Point<3> &x) { return Point<3>(x[0], low + (high - low) * x[1], x[2]); }};
}

/** A block `one` on a block `other` of these degrees, whose cells do not match, of two meshes. */
Scene<3> blocks(const unsigned int one, const unsigned int other, const Overrides &entries)
{
  const Overrides common{{"Material/Young's modulus", "20"},
                         {"Material/Poisson's ratio", "0.3"},
                         {"Adaptivity/Method", "hup2"},
                         {"Adaptivity/Maximum steps", "1"},
                         {"Body one/Start degree", std::to_string(one)},
                         {"Body other/Start degree", std::to_string(other)}};
  return two_bodies(block(1, 1.5, {{2, 1, 2}}), block(0, 1, {{3, 1, 1}}), {"bottom", "top"},
                    common + entries);
}

/** Pressed down and moved askew. */
const Overrides sheared{{"Boundary one.top/Displacement", "0.02; -0.02; 0.01"},
                        {"Boundary other.bottom/Displacement", "0; 0; 0"}};

const Overrides graded{{"Body one/Graded towards", "0, 1, 0"},
                       {"Body one/Grading levels", "1"},
                       {"Body other/Graded towards", "1, 1, 1"},
                       {"Body other/Grading levels", "1"}};

/** Under its weight a column between planes of symmetry moves by a quadratic, which all degrees have: load for load. */
TEST(Degrees, HoldWhatTheyHaveInCommon)
{
  Overrides column{
      {"Material/Thermal expansion", "0.01"},          {"Temperature/Expression", "-1"},
      {"Body force/Expression", "0; -0.3; 0"},         {"Boundary one.top/Rigid", "true"},
      {"Boundary one.top/Force", "free; -0.2; free"},  {"Boundary one.top/Rotation", "0; 0; 0"},
      {"Boundary one.top/Displacement", "0; free; 0"}, {"Boundary other.bottom/Spring", "7; 0"}};
  for (const char *const body : {"one", "other"})
    for (const char *const side : {"left", "right", "front", "back"})
      column.emplace_back("Boundary " + std::string(body) + "." + side + "/Symmetry", "true");
  double known = 0;
  for (const auto &[one, other, linear, slave] :
       {std::tuple(2U, 2U, LinearMethod::direct, "one.bottom"),
        {2U, 4U, LinearMethod::multigrid, "one.bottom"},
        {4U, 2U, LinearMethod::multigrid, "one.bottom"},
        {3U, 2U, LinearMethod::multigrid, "other.top"},
        {2U, 3U, LinearMethod::amg, "other.top"},
        {5U, 2U, LinearMethod::direct, "one.bottom"}})
  {
    Scene<3> scene =
        blocks(one, other, column + graded + Overrides{{"Contact joint/Slave", slave}});
    scene.solver.linear = linear;
    scene.solver.primal_tolerance = 1e-13;
    steps_of<3>(scene,
                [&, &one = one, &other = other](const StepReport<3> &step)
                {
                  EXPECT_EQ(step.size.p_min(), std::min(one, other));
                  EXPECT_EQ(step.size.p_max(), std::max(one, other));
                  ASSERT_FALSE(step.contact.at(0).points.empty());
                  for (const ContactPoint<3> &point : step.contact.at(0).points)
                    EXPECT_NEAR(point.normal_traction, -0.2 - 0.3 * 0.5, 1e-11);
                  known = known == 0 ? step.energies.lagrangian : known;
                  EXPECT_NEAR(step.energies.lagrangian, known, 1e-11 * std::abs(known));
                  EXPECT_LT(step.norms.total, 1e-8 * step.energies.norm);
                });
  }
}

/** One degree of both bodies is that of all. */
TEST(Degrees, AreStartDegreeWhereTheyAreTheSame)
{
  for (const unsigned int degree : {2U, 3U})
  {
    Scene<3> scene = blocks(0, 0, sheared + Overrides{{"Contact joint/Friction bound", "0.05"}}),
             own = blocks(degree, degree,
                          sheared + Overrides{{"Contact joint/Friction bound", "0.05"}});
    scene.adaptivity.start_degree = degree;
    EXPECT_EQ(steps_of<3>(scene).back().lagrangian, steps_of<3>(own).back().lagrangian);
  }
}

/** All solvers find one energy, under each law, and with more of one degree it comes nearer to that of two. */
TEST(Degrees, AgreeUnderEachLaw)
{
  for (const Overrides &law : {Overrides{{"Contact joint/Law", "tied"}},
                               Overrides{{"Contact joint/Friction bound", "0.05"}},
                               Overrides{{"Contact joint/Friction coefficient", "0.3"}}})
  {
    const auto energy =
        [&](const unsigned int one, const unsigned int other, const LinearMethod linear)
    {
      Scene<3> scene = blocks(one, other, sheared + law);
      scene.solver.linear = linear;
      return steps_of<3>(scene).back().lagrangian;
    };
    const double low = energy(2, 2, LinearMethod::multigrid),
                 high = energy(3, 3, LinearMethod::multigrid),
                 mixed = energy(2, 3, LinearMethod::multigrid);
    EXPECT_LT(mixed, low);
    EXPECT_GT(mixed, high);
    EXPECT_NEAR(energy(2, 3, LinearMethod::direct), mixed, 1e-9 * std::abs(mixed));
    EXPECT_NEAR(energy(2, 3, LinearMethod::amg), mixed, 1e-9 * std::abs(mixed));
  }
}
} // namespace
