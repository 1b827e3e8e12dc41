// SPDX-License-Identifier: LGPL-2.1-or-later
// What finds stick and slip: Newton's method, what takes its place, and where they stop.
#include "runs.h"

#include <hpvi/base/numerical_failure.h>
#include <hpvi/driver/adaptive_solver.h>

#include <algorithm>

namespace
{
using namespace space;

/** Cut off after one step the augmented Lagrangian ends where Newton's method does. */
template <int dim>
void expect_fallback(const StepReport<dim> &step)
{
  PrimalSystem<dim> system(step.primal->space);
  NewtonMatrix<dim> matrix(step.primal->space, system);
  SemismoothNewton<dim> newton(step.primal->space, system, matrix);
  DistributedVector v = step.primal->space.owned_vector();
  std::vector<ContactVector<dim>> lambda;
  NewtonSettings settings;
  settings.residual = 1e-10;
  settings.maximum_steps = 1;
  const NewtonReport report = newton.solve(v, lambda, settings);
  EXPECT_TRUE(report.is_cut_off);
  EXPECT_EQ(report.steps, 1);
  EXPECT_GT(report.augmented_steps, 3);
  EXPECT_EQ(report.n_slipping, step.primal->newton.n_slipping);
  DistributedVector difference = step.primal->space.displacement(v);
  difference -= step.primal->u;
  EXPECT_LT(difference.l2_norm(), 1e-7 * step.primal->u.l2_norm());
}

/** Before it is asked for: a gigabyte of matrices is worth a note, a tenth of it is not. */
TEST(Newton, SaysHowMuchMemoryItIsAboutToTake)
{
  const auto note_of = [](const std::string &subdivisions)
  {
    std::string note;
    const Scene<3> scene = slab({{"Geometry/Subdivisions", subdivisions},
                                 {"Solver/Linear", "amg"},
                                 {"Adaptivity/Start degree", "4"},
                                 {"Adaptivity/Maximum unknowns", "200000"}});
    EXPECT_THROW(AdaptiveSolver<3>(scene, MPI_COMM_SELF)
                     .run([](const StepReport<3> &) {},
                          [&](const Progress &progress)
                          {
                            note = progress.note;
                            if (progress.stage.find("assembling") == 0)
                              throw NumericalFailure("enough");
                          }),
                 NumericalFailure);
    return note;
  };
  EXPECT_EQ(note_of("4, 4, 2"), "");
  EXPECT_NE(note_of("8, 8, 8").find("107811 unknowns take 1.37 GB of memory"), std::string::npos);
}

TEST(Newton, GivesWayToTheAugmentedLagrangian)
{
  steps_of<3>(slab({{"Adaptivity/Maximum steps", "2"}}), expect_fallback<3>);
  Scene<2> plane = read_scene<2>("prm/han-6-12.prm", Overrides{given::steps("hap3", "3")});
  plane.solver.primal_tolerance = 1e-11;
  steps_of<2>(plane, expect_fallback<2>);
}

/** From all discs sticking Newton's method would take more steps the more there are. */
TEST(Newton, StepsDoNotGrowWithTheDiscs)
{
  std::vector<unsigned int> steps;
  for (const char *const subdivisions : {"150, 1", "600, 1"})
  {
    Scene<2> scene =
        read_scene<2>("prm/han-6-12.prm", Overrides{given::steps("hap2", "1"),
                                                    {"Geometry/Subdivisions", subdivisions}});
    scene.solver.primal_tolerance = 1e-10;
    double reduced = 0;
    AdaptiveSolver<2>(scene).run([&](const StepReport<2> &step)
                                 { reduced = step.energies.lagrangian; });
    const auto primal = steps_of<2>(scene,
                                    [&](const StepReport<2> &step)
                                    {
                                      EXPECT_FALSE(step.primal->newton.is_cut_off);
                                      steps.push_back(step.primal->newton.steps +
                                                      step.primal->newton.augmented_steps);
                                    });
    EXPECT_NEAR(primal[0].lagrangian, reduced, 1e-9 * std::abs(reduced));
  }
  EXPECT_LE(steps[1], steps[0] + 10);
  EXPECT_LE(steps[1], 50U);
}

/** In space not even then: all starts by Newton's method, and two sets of states in turns are left half way. */
TEST(Newton, StartsManyContactDofsOfSpace)
{
  for (const Overrides &entries : {Overrides{{"Geometry/Subdivisions", "24, 1, 24"}},
                                   Overrides{{"Geometry/Lower corner", "0, 0, 0"},
                                             {"Geometry/Subdivisions", "12, 3, 12"},
                                             {"Material/Young's modulus", "100"},
                                             {"Boundary top/Displacement", "0.01; -0.01; 0"},
                                             {"Boundary bottom/Gap", ""},
                                             {"Boundary bottom/Friction bound", ""},
                                             {"Boundary bottom/Friction coefficient", "0.3"}}})
  {
    const Overrides all{
        entries, given::steps("hup2", "1"), {"Adaptivity/Maximum unknowns", "100000"}};
    steps_of<3>(read_scene<3>("prm/dome.prm", all),
                [](const StepReport<3> &step)
                {
                  EXPECT_EQ(step.primal->newton.augmented_steps, 0u);
                  EXPECT_LE(step.primal->newton.steps, 20u);
                });
  }
}

/** Where no tolerance is named what Newton's method leaves is known, and small beside the indicator. */
TEST(Newton, StopsWhereTheEstimatedErrorSaysSo)
{
  Scene<3> scene = slab({{"Adaptivity/Maximum steps", "3"}});
  std::vector<unsigned int> exact_cg, cg;
  const auto exact = steps_of<3>(scene,
                                 [&](const StepReport<3> &step)
                                 {
                                   exact_cg.push_back(step.primal->newton.cg_steps);
                                   // few, for H is the derivative of what slips
                                   EXPECT_LE(step.primal->newton.steps, 8U);
                                   EXPECT_EQ(step.primal->newton.augmented_steps, 0U);
                                 });
  scene.solver.primal_tolerance = 0;
  unsigned int k = 0;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                EXPECT_LE(step.primal->newton.error, 1e-2 * step.scaled_estimate);
                const double rise = step.energies.lagrangian - exact[k].lagrangian;
                EXPECT_LE(std::abs(rise), std::pow(step.primal->newton.error, 2) + 1e-8);
                cg.push_back(step.primal->newton.cg_steps);
                ++k;
              });
  EXPECT_LT(2 * cg.back(), exact_cg.back() + cg.back()); // it takes fewer
}

/** What supports, contact and loads do to the body adds up to nothing, and to the same on both paths. */
TEST(Newton, ForcesAreThoseOfTheReducedPath)
{
  Scene<2> scene = read_scene<2>("prm/han-6-12.prm", Overrides{given::steps("hap3", "3")});
  scene.solver.primal_tolerance = 1e-12;
  std::vector<Equilibrium<2>> reduced, primal;
  AdaptiveSolver<2>(scene).run([&](const StepReport<2> &step)
                               { reduced.push_back(step.equilibrium); });
  steps_of<2>(scene, [&](const StepReport<2> &step) { primal.push_back(step.equilibrium); });
  const Equilibrium<2> &one = reduced.back(), &other = primal.back();
  EXPECT_LT(other.force_imbalance, 1e-10);
  EXPECT_LT(other.moment_imbalance, 1e-10);
  ASSERT_EQ(one.reactions.size(), 2);
  ASSERT_EQ(other.reactions.size(), 2);
  for (unsigned int b = 0; b < 2; ++b)
  {
    EXPECT_EQ(one.reactions[b].boundary, other.reactions[b].boundary);
    EXPECT_LT((one.reactions[b].force - other.reactions[b].force).norm(), 1e-8);
    EXPECT_NEAR(one.reactions[b].moment, other.reactions[b].moment, 1e-8);
  }
}

/** A fiftieth of the contact dofs may change its state before multigrid is set up anew, and no more. */
TEST(Newton, SetsMultigridUpWhereMoreThanAFiftiethHasChanged)
{
  const Scene<3> scene = slab({{"Geometry/Subdivisions", "10, 1, 10"}, given::steps("hup2", "1")});
  steps_of<3>(scene,
              [](const StepReport<3> &step)
              {
                ASSERT_EQ(step.primal->space.n_discs, 100u);
                PrimalSystem<3> system(step.primal->space);
                NewtonMatrix<3> matrix(step.primal->space, system, LinearMethod::amg);
                std::vector<ContactDofState<3>> states(step.primal->space.contact.size());
                const auto setups = [&](const unsigned int begin, const unsigned int end)
                {
                  for (unsigned int k = begin; k < end; ++k)
                    states[k].is_held = true;
                  matrix.linearise(states);
                  return matrix.n_setups;
                };
                EXPECT_EQ(setups(0, 1), 1u); // the first
                EXPECT_EQ(setups(1, 3), 1u);
                EXPECT_EQ(setups(3, 6), 2u);
              });
}

/** Multigrid does not see what hardly any change of volume asks for: a factorisation does, and the run says so. */
TEST(Newton, MultigridThatBreaksDownGivesWayToAFactorisation)
{
  Scene<3> scene =
      slab({{"Material/Poisson's ratio", "0.49999"}, {"Adaptivity/Maximum steps", "2"}});
  scene.solver.primal_tolerance = 1e-8;
  double multigrid = 0;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                multigrid = step.energies.lagrangian;
                if (step.stopped_by.empty())
                  return;
                EXPECT_TRUE(step.primal->newton.fell_back);
                EXPECT_TRUE(std::any_of(step.warnings.begin(), step.warnings.end(),
                                        [](const Warning &warning)
                                        { return warning.kind == WarningKind::multigrid; }));
              });
  scene.solver.linear = LinearMethod::direct;
  EXPECT_NEAR(multigrid, steps_of<3>(scene).back().lagrangian, 1e-7 * std::abs(multigrid));
}
} // namespace
