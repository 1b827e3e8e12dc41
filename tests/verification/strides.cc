// SPDX-License-Identifier: LGPL-2.1-or-later
// hpa4: several layers and degrees in one step, beside hpa3.
#include "discretisation.h"

#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/driver/strides.h>

#include <deal.II/grid/grid_generator.h>

#include <numeric>

namespace
{
using namespace verification;

struct Walk
{
  std::vector<double> unknowns, estimates, errors;

  double all() const
  {
    return std::accumulate(unknowns.begin(), unknowns.end(), 0.);
  }
};

/** To an indicator of @p tolerance, by itself. */
Walk walk(const std::string &scene, const std::string &method, const std::string &tolerance,
          const Overrides &entries)
{
  Walk result;
  each_step<2>(shipped_scene(scene, with({given::steps(method, "40", "0"),
                                          {"Adaptivity/Indicator", "residual"},
                                          {"Adaptivity/Tolerance on", "residual"},
                                          {"Adaptivity/Tolerance", tolerance},
                                          {"Error/Bound", "false"}},
                                         entries)),
               [&](const StepReport<2> &step)
               {
                 result.unknowns.push_back(step.size.n_free);
                 result.estimates.push_back(step.relative_estimate);
                 result.errors.push_back(step.errors.energy / step.energies.norm);
               });
  return result;
}

/** Corners, ends of zones inside edges, two bodies, Coulomb's law, curves, a load that jumps. */
struct Ground
{
  std::string name, scene, tolerance;
  unsigned int most_steps;
  double most_unknowns; ///< of those of hpa3, in the last step
  double most_in_all;   ///< and in all steps
  Overrides entries = {};
};

std::ostream &operator<<(std::ostream &out, const Ground &ground)
{
  return out << ground.name;
}

class Strides : public ::testing::TestWithParam<Ground>
{
};

/** Mostly with fewer unknowns than hpa3 solves for in all its steps, and with not many more in the last one. */
TEST_P(Strides, ComeThereInFewSteps)
{
  const Ground ground = GetParam();
  const Walk old = walk(ground.scene, "hpa3", ground.tolerance, ground.entries),
             walked = walk(ground.scene, "hpa4", ground.tolerance, ground.entries);
  ASSERT_LT(old.estimates.back(), std::stod(ground.tolerance));
  ASSERT_LT(walked.estimates.back(), std::stod(ground.tolerance));
  EXPECT_LE(walked.unknowns.size(), ground.most_steps);
  EXPECT_LE(walked.unknowns.back(), ground.most_unknowns * old.unknowns.back());
  EXPECT_LE(walked.all(), ground.most_in_all * old.all());
  for (unsigned int k = 1; k < walked.unknowns.size(); ++k)
    EXPECT_LE(walked.unknowns[k], 8 * walked.unknowns[k - 1]) << "step " << k + 1;
}

INSTANTIATE_TEST_SUITE_P(, Strides,
                         ::testing::Values(Ground{"corners", "han-6-12", "1e-5", 6, 1.6, 0.8},
                                           Ground{"endsOfContact", "hertz", "1e-4", 7, 2.2,
                                                  1.5}, // they move
                                           Ground{"ofAWeakEnd", "stick-slip", "1e-6", 6, 1.6, 0.8},
                                           Ground{"bodies", "blocks", "1e-4", 6, 2.2, 0.8},
                                           Ground{"coulomb", "ssnv128", "1e-5", 7, 2.5, 0.8},
                                           Ground{"lifted", "resting", "1e-4", 7, 2.2, 0.8},
                                           Ground{"anEndAtAVertex", "punch", "1e-3", 8, 2.2, 0.8},
                                           Ground{"aLoadThatJumps", "ballast", "1e-5", 6, 2,
                                                  0.7}), // nothing else near there is singular
                         [](const auto &info) { return info.param.name; });

/** Where the exact solution is known, the error falls with the indicator. */
TEST(StridesBeside, TheExactSolution)
{
  for (const auto &[scene, transition] : Overrides{{"hertz", ""}, {"stick-slip", "0.1"}})
  {
    const Walk walked = walk(
        scene, "hpa4", "1e-6",
        transition.empty() ? Overrides() : Overrides{{"Exact solution/Transition", transition}});
    for (unsigned int k = 1; k < walked.errors.size(); ++k)
      EXPECT_LT(walked.errors[k], walked.estimates[k]) << scene << ", step " << k + 1;
    EXPECT_LT(walked.errors.back(), 1e-4) << scene;
  }
}

TEST(StridesBeside, ATolerance)
{
  EXPECT_EQ(part_of_stride(0), 0.1);
  for (const double needed : {0.9, 0.3, 0.06})
    EXPECT_EQ(part_of_stride(needed), 0.75 * needed);
  EXPECT_NEAR(part_of_stride(0.01), 0.1, 1e-12);
  EXPECT_NEAR(part_of_stride(1e-4), 0.1, 1e-12);
  EXPECT_GT(part_of_stride(0.04), 0.1); // two of the same size
}
} // namespace
