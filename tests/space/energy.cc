// SPDX-License-Identifier: LGPL-2.1-or-later
// The upper end of the least energy, J(u_N): where u_N is admissible, and nowhere else.
#include "reduced_path.h"

#include <hpvi/plane/matching.h>
#include <hpvi/space/upper_energy.h>

#include <numeric>

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

/** A cube on a curved foundation, with loads that are no polynomials. */
Scene<3> cube(const Overrides &entries)
{
  return slab({{"Geometry/Upper corner", "1, 1, 1"},
               {"Geometry/Subdivisions", "2, 2, 2"},
               {"Material/Young's modulus", "1"},
               {"Boundary left/Traction", ""},
               {"Boundary right/Displacement", ""},
               {"Boundary left/Symmetry", "true"},
               {"Boundary back/Displacement", "0; 0; 0"},
               {"Boundary top/Traction", "0.05; -0.3*(1 + x^2); 0.1"},
               {"Body force/Expression", "0.1*x*y; 0; -0.3*exp(x)"},
               {"Boundary bottom/Friction bound", ""},
               {"Boundary bottom/Contact", "unilateral"},
               {"Boundary bottom/Gap", "0.01 + 0.3*(x - 0.4)^2"},
               entries});
}

Scene<3> dome(const Overrides &entries)
{
  return read_scene<3>("prm/dome.prm", entries);
}

struct BoundCase
{
  const char *name;
  Scene<3> (*scene)(const Overrides &);
  Overrides entries;
  double widest; ///< of the bound, relative to |u_N|_a
};

/** Its parts make the total and the bound of the energy. */
void expect_theorem(const ErrorBound &bound, const bool is_linear)
{
  const auto sum = [](const std::vector<double> &all)
  { return std::accumulate(all.begin(), all.end(), 0.); };
  const double b = std::sqrt(sum(bound.moved)), gap = (bound.slip * bound.slip - b * b) / 2,
               A = std::sqrt(sum(bound.squares) - bound.slip * bound.slip);
  EXPECT_EQ(gap > 0, !is_linear);
  EXPECT_GT(bound.oscillation, 1e-3 * bound.stress);
  EXPECT_GE(A, std::hypot(bound.stress, bound.oscillation));
  EXPECT_NEAR(bound.total, least_root(A, gap, b), 1e-9 * bound.total);
  EXPECT_NEAR(bound.energy, std::pow(A + b, 2) / 2 + gap, 1e-9 * bound.energy);
}

/** J of a far finer mesh lies in the interval of each step; the bound is above what J says of the error, and at most twice as much as it says at most. */
TEST(BoxBound, HoldsOfFinerMeshes)
{
  const std::vector<BoundCase> cases{
      {"slab", [](const Overrides &entries) { return slab(entries); }, {}, 0.15},
      {"dome", dome, {}, 0.3},
      {"cube", cube, {{"Adaptivity/Start degree", "3"}}, 0.25},
      {"without contact",
       cube,
       {{"Boundary bottom/Contact", "none"}, {"Boundary bottom/Gap", ""}},
       0.25},
      {"fibres askew", [](const Overrides &entries) { return slab(entries); },
       fibres("1, 2, 0.5; 0, 1, 1"), 0.3}};
  for (const BoundCase &one : cases)
  {
    double J = 0;
    Overrides finer{given::steps("hap3", "3")}, coarse{given::steps("hap2", "2")};
    for (Overrides *const of_run : {&finer, &coarse})
      of_run->insert(of_run->begin(), one.entries.begin(), one.entries.end());
    coarse.emplace_back("Error/Bound", "true");
    steps_of<3>(one.scene(finer), [&](const StepReport<3> &step) { J = step.energies.energy; });
    const bool is_linear = one.name == std::string("without contact");
    double last = 0;
    steps_of<3>(one.scene(coarse),
                [&](const StepReport<3> &step)
                {
                  ASSERT_TRUE(step.bound) << one.name << ": " << step.no_bound;
                  const ErrorBound &bound = *step.bound;
                  EXPECT_LT(bound.imbalance, 1e-9) << one.name;
                  expect_theorem(bound, is_linear);
                  EXPECT_LT(step.energies.energy - bound.energy_below, J) << one.name;
                  EXPECT_GT(step.energies.energy + bound.energy_above, J) << one.name;
                  if (is_linear)
                  {
                    const double error = std::sqrt(2 * (step.energies.energy - J));
                    EXPECT_GT(bound.total, error);
                    EXPECT_LT(bound.total, 2 * error);
                  }
                  last = step.relative_bound;
                });
    EXPECT_LT(last, one.widest) << one.name;
  }
}

/** A support that ends on a side holds the edges of larger cells there. */
TEST(BoxBound, HoldsWhereSupportsEnd)
{
  const auto run = [](const Overrides &adaptivity)
  {
    Overrides all{{"Geometry/Upper corner", "2, 1, 1"},
                  {"Geometry/Subdivisions", "2, 1, 1"},
                  {"Boundary bottom/Contact", "none"},
                  {"Boundary bottom/Friction bound", ""},
                  {"Boundary held/On", "bottom"},
                  {"Boundary held/Where", "1 - x"},
                  {"Boundary held/Contact", "bilateral"},
                  {"Boundary left/Displacement", "0; free; 0"},
                  {"Boundary left/Traction", "0; 0.2*(z-0.5)^3; 0"},
                  {"Boundary right/Displacement", ""},
                  {"Boundary right/Traction", "0; 0.1; 0"},
                  {"Error/Bound", "true"},
                  adaptivity};
    std::pair<double, double> ends;
    steps_of<3>(slab(all),
                [&](const StepReport<3> &step)
                {
                  ASSERT_TRUE(step.bound) << step.no_bound;
                  EXPECT_LT(missed_displacement(step.primal->space, step.primal->u), 1e-13);
                  ends = {step.energies.energy - step.bound->energy_below,
                          step.energies.energy + step.bound->energy_above};
                });
    return ends;
  };
  const auto coarse = run({given::steps("hap2", "2"), {"Adaptivity/hap threshold", "1"}}),
             fine = run(given::steps("hup2", "3"));
  EXPECT_LT(coarse.first, fine.second);
  EXPECT_LT(fine.first, coarse.second);
}

TEST(BoxBound, SaysWhyThereIsNone)
{
  const std::vector<std::pair<Overrides, std::string>> cases{
      {{given::coulomb("0.3")}, "contact that does not open"},
      {{given::coulomb("4"), {"Boundary bottom/Contact", "unilateral"}}, "too strong for a bound"},
      {{given::coulomb("0.3"),
        {"Boundary bottom/Contact", "unilateral"},
        {"Boundary left/Traction", ""},
        {"Boundary left/Displacement", "0; free; free"},
        {"Boundary top/Traction", "0; -1; 0"},
        {"Boundary right/Displacement", "free; 0; 0"}},
       "can slide but not lift"},
      {{given::coulomb("0.3"),
        {"Boundary bottom/Contact", "unilateral"},
        {"Boundary smooth/On", "bottom"},
        {"Boundary smooth/Where", "x - 2"},
        {"Boundary smooth/Contact", "unilateral"}},
       "can slide but not lift"},
      {{given::coulomb("if(x < 2.3, 0.3, 0.2)"), {"Boundary bottom/Contact", "unilateral"}},
       "the coefficient of friction jumps at (2."},
      {{given::coulomb("0.3"),
        {"Boundary bottom/Contact", "unilateral"},
        {"Boundary other/On", "bottom"},
        {"Boundary other/Where", "x - 2"},
        {"Boundary other/Contact", "unilateral"},
        {"Boundary other/Friction coefficient", "0.2"}},
       "the coefficient of friction jumps at (2, 0"},
      {{given::coulomb("0.3"),
        {"Boundary bottom/Contact", "unilateral"},
        {"Boundary bottom/Friction bound", "1"},
        {"Boundary bottom/Friction law", "limited"}},
       "up to a bound alone"},
      {{{"Boundary right/Displacement", "0.01*sin(y); 0; 0"}}, "no polynomials"},
      {{{"Boundary left/Spring", "10; 0"}}, "springs"},
      {{{"Boundary left/Traction", ""},
        {"Boundary left/Rigid", "true"},
        {"Boundary left/Displacement", "0.1; 0; 0"},
        {"Boundary left/Rotation", "0; free; 0"}},
       "rigid plate"},
      {{{"Material/Thermal expansion", "1e-5"}, {"Temperature/Expression", "10 + x"}},
       "initial strain"},
      {{{"Boundary left/Traction", "if(y > 3.985, 400, 0); -0.75; 0.5"}}, "not smooth"},
      {{{"Error/Bound", "false"}}, "Error/Bound = false"}};
  for (const auto &[entries, why] : cases)
  {
    Overrides all{{"Error/Bound", "true"}, given::steps("hup2", "1")};
    all.insert(all.end(), entries.begin(), entries.end());
    steps_of<3>(slab(all),
                [&](const StepReport<3> &step)
                {
                  EXPECT_FALSE(step.bound) << why;
                  EXPECT_NE(step.no_bound.find(why), std::string::npos) << step.no_bound;
                });
  }
  // The table of the program has no column for what the scene rules out.
  EXPECT_EQ(no_error_bound(read_scene<3>("prm/column-base.prm", {})),
            "contact alone holds the body");
}
} // namespace
