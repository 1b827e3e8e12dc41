// SPDX-License-Identifier: LGPL-2.1-or-later
// The guaranteed bound on skew parallelograms: there is one, in balance and above the error, whatever holds, loads or
// touches the edges that meet at a corner.
#include "discretisation.h"

#include <hpvi/bound/error_bound.h>

namespace
{
using namespace verification;

/** With edges of length 2 and 1 and an angle at the lower left corner. */
Overrides parallelogram(const double angle, const std::string &subdivisions)
{
  const double c = std::cos(angle * numbers::PI / 180), s = std::sin(angle * numbers::PI / 180);
  return {given::quadrilateral("Geometry",
                               "0, 0; 2, 0; " + in_digits(2 + c) + ", " + in_digits(s) + "; " +
                                   in_digits(c) + ", " + in_digits(s),
                               subdivisions),
          given::elastic("10", "0.3"), given::steps("hup2", "1")};
}

const Overrides held_right = {{"Boundary right/Displacement", "0; 0"}};

/** Each way of holding an edge beside a slanted one, and slanted edges themselves. */
const std::vector<Overrides> supports = {
    held_right + Overrides{given::rough("bottom", "bilateral", "0.02")},
    held_right + Overrides{given::rough("bottom", "unilateral", "0.02")},
    held_right + Overrides{given::rough("bottom", "tangential", "0.02")},
    held_right + Overrides{{"Boundary bottom/Displacement", "free; 0"}},
    held_right + Overrides{{"Boundary bottom/Displacement", "0; free"}},
    {{"Boundary bottom/Displacement", "free; 0"}, {"Boundary right/Displacement", "0; free"}},
    {{"Boundary bottom/Displacement", "0; 0"},
     {"Boundary right/Displacement", "free; 0"},
     {"Boundary right/Traction", "0.05*cos(3*y); 0"}},
    {{"Boundary bottom/Displacement", "0; 0"},
     {"Boundary right/Displacement", "0; free"},
     {"Boundary right/Traction", "0; 0.05*cos(3*y)"}},
    {{"Boundary bottom/Displacement", "free; 0"}, given::rough("right", "bilateral", "0.02")},
    {{"Boundary bottom/Displacement", "0; 0"}}};

/** Tractions of a polynomial, of none, and of one that jumps inside a cell. */
const std::vector<std::string> loads = {"0; -0.1*(1 + x)", "0.05*sin(4*x); -0.1*cos(3*x)",
                                        "0; if(x < 1.1, -0.1, 0)"};

const std::vector<double> angles = {90., 89.9, 80., 60., 45., 30.};

/** On the smallest meshes both ends of an edge may be corners of the body. */
TEST(SkewBound, HasAStressInBalanceOnTheSmallestMeshes)
{
  for (const double angle : angles)
    for (unsigned int support = 0; support < supports.size(); ++support)
      for (const std::string &load : {loads[1], loads[2]})
        for (const auto &[subdivisions, p] :
             {std::pair("1, 1", 2), std::pair("1, 1", 3), std::pair("2, 1", 2)})
        {
          SCOPED_TRACE(in_digits(angle) + ", support " + std::to_string(support) + ", " + load +
                       ", " + subdivisions + ", p = " + std::to_string(p));
          const Scene<2> scene = scene_of(parallelogram(angle, subdivisions) + supports[support] +
                                          Overrides{{"Boundary top/Traction", load},
                                                    {"Boundary left/Traction", "0.01*y^3; 0"}});
          const RandomMesh mesh(scene, 1, 0, p, p);
          const Laboratory lab(scene, mesh);
          const ErrorBound bound = ErrorBounds().compute(lab.solve(), lab.discretisation);
          EXPECT_GT(bound.stress, 0.);
          EXPECT_LE(bound.imbalance, 1e-12);
        }
}

/** What R leaves out of account: what becomes of a load on an edge has its force and moment, whatever its ends had to meet. */
TEST(SkewBound, KeepsForceAndMomentOfLoads)
{
  const EquilibratedStress::Parts no_contact = [](unsigned int, unsigned int)
  { return std::vector<double>(); };
  for (const double angle : angles)
    for (const std::string side : {"left", "right"})
      for (const std::string held : {"0; free", "free; 0"})
        for (const unsigned int p : {2, 3})
        {
          SCOPED_TRACE(in_digits(angle) + ", " + side + " " + held + ", p = " + std::to_string(p));
          const Scene<2> scene =
              scene_of(parallelogram(angle, "2, 1") +
                       Overrides{{"Boundary bottom/Displacement", "0; 0"},
                                 {"Boundary top/Traction", "0; 0.1*cos(3*x)"},
                                 {"Boundary " + side + "/Displacement", held},
                                 {"Boundary " + side + "/Traction",
                                  held == "0; free" ? "0; cos(3*y)" : "cos(3*y); 0"}});
          const RandomMesh mesh(scene, 1, 0, p, p);
          const Laboratory lab(scene, mesh);
          const Solution<2> solution = lab.solve();
          EquilibrationCache cache;
          const EquilibratedStress stress(solution, no_contact, no_contact, cache);
          for (unsigned int e = 0; e < stress.patches().edges().size(); ++e)
            for (unsigned int c = 0; c < 2; ++c)
            {
              const StressEdge &edge = stress.patches().edges()[e];
              if (!edge.at_boundary() || edge.components[c].is_unknown)
                continue;
              double force = 0, moment = 0; // of loads of 1
              for (const auto &[t, weight] : stress.prescribed().points(e))
              {
                const double missed =
                    stress.prescribed().value(e, t) * edge.components[c].direction -
                    legendre::evaluate(stress.tractions()[e][c], 2 * t - 1);
                force += weight * missed;
                moment += weight * t * missed;
              }
              EXPECT_LE(std::abs(force), 1e-13);
              EXPECT_LE(std::abs(moment), 1e-13);
            }
        }
}

/** Supports take turns, so that each angle has all loads and each degree all supports. */
TEST(SkewBound, IsAboveTheErrorAndNear)
{
  unsigned int turn = 0;
  for (const double angle : angles)
    for (unsigned int load = 0; load < loads.size(); ++load, ++turn)
    {
      const Overrides entries = parallelogram(angle, "4, 2") + supports[turn % supports.size()] +
                                Overrides{{"Boundary top/Traction", loads[load]}};
      const ReferenceFile reference(
          scene_of(entries +
                   Overrides{given::steps("hpa2", "40"), {"Adaptivity/Maximum unknowns", "2000"}}));
      for (unsigned int p = 2; p <= 5; ++p)
        each_step<2>(scene_of(entries + Overrides{{"Adaptivity/Start degree", std::to_string(p)},
                                                  {"Error/Reference solution", reference.path}}),
                     [&](const StepReport<2> &step)
                     {
                       SCOPED_TRACE(in_digits(angle) + ", support " +
                                    std::to_string(turn % supports.size()) + ", " + loads[load] +
                                    ", p = " + std::to_string(p));
                       ASSERT_TRUE(step.bound) << step.no_bound;
                       EXPECT_GE(step.bound->total, step.errors.energy);
                       EXPECT_LE(step.bound->total,
                                 3 * step.errors.energy + 2 * step.bound->oscillation);
                     });
    }
}
} // namespace
