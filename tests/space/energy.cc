// SPDX-License-Identifier: LGPL-2.1-or-later
// The upper end of the least energy, J(u_N): where u_N is admissible, and nowhere else.
#include "reduced_path.h"

namespace
{
using namespace space;

std::vector<double> upper_ends(const Scene<3> &scene)
{
  std::vector<double> result;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                EXPECT_FALSE(step.bound);
                result.push_back(step.energy_high);
              });
  return result;
}

/** Example 5.2 as a slab of plane strain: above its limit, and it falls. */
TEST(UpperEnergy, IsBoundedFromAbove)
{
  Scene<3> scene = slab({given::steps("hap2", "3"),
                         {"Geometry/Subdivisions", "2, 2, 1"},
                         {"Boundary left/Traction", "1.5*(5 - y); -0.75; 0"},
                         {"Boundary front/Displacement", "free; free; 0"},
                         {"Boundary back/Displacement", "free; free; 0"}});
  double previous = 0;
  for (const double high : upper_ends(scene))
  {
    EXPECT_GT(high / 2, -4.879036);
    EXPECT_LT(high, previous);
    previous = high;
  }
}

/** Where loads are exact it is J(u_N), friction at all points. */
TEST(UpperEnergy, IsThatOfTheThesis)
{
  steps_of<3>(slab({{"Adaptivity/Maximum steps", "2"}}),
              [](const StepReport<3> &step)
              {
                EXPECT_NEAR(step.energy_high, step.energies.energy,
                            1e-12 * std::abs(step.energies.energy));
                EXPECT_GT(step.energies.slack, 1e-6);
              });
}

/** Where the rule of the path adds work that the loads do not do, it is raised. */
TEST(UpperEnergy, KnowsWhatRulesMiss)
{
  const Overrides wavy{{"Boundary left/Traction", "exp(y) - 400; -0.75; 0.5"},
                       given::steps("hup2", "1")};
  steps_of<3>(slab(wavy),
              [](const StepReport<3> &step)
              {
                EXPECT_GT(step.energy_high, step.energies.energy);
                EXPECT_NEAR(step.energy_high, step.energies.energy,
                            1e-3 * std::abs(step.energies.energy));
              });
}

TEST(UpperEnergy, IsOpenElsewhere)
{
  const Overrides once{{"Adaptivity/Maximum steps", "1"}};
  const std::vector<Overrides> cases{
      {{"Boundary bottom/Contact", "unilateral"}},
      {given::coulomb("0.3")},
      {{"Boundary right/Displacement", "0.01*sin(y); 0; 0"}},
      {{"Boundary left/Traction", "if((y - 1.3)^2 + (z - 1)^2 < 0.1, 40, 0); 0; 0"}}};
  for (Overrides entries : cases)
  {
    entries.insert(entries.end(), once.begin(), once.end());
    EXPECT_TRUE(std::isnan(upper_ends(slab(entries)).at(0))) << entries[0].first;
  }
  // a displacement within the space is admissible
  EXPECT_FALSE(std::isnan(
      upper_ends(slab({{"Boundary right/Displacement", "0.01*y*(4 - y); 0; 0"}, once[0]})).at(0)));
}
} // namespace
