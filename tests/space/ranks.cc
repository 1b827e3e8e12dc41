// SPDX-License-Identifier: LGPL-2.1-or-later
// The same run on one process and on all that mpirun has started: in ctest on 2 and 3.
#include "curved_bodies.h"
#include "runs.h"

#include <hpvi/base/input_error.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/space/consistent_constraints.h>

#include <deal.II/dofs/dof_tools.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace
{
using namespace space;

unsigned int n_reductions = 0; ///< that this process has taken part in

bool is_first()
{
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
}

/** What @p run gives the first process, which compares, by itself; the others sleep. */
template <class Run>
auto alone_by(const Run &run)
{
  decltype(run(MPI_COMM_SELF)) result;
  if (is_first())
    result = run(MPI_COMM_SELF);
  MPI_Request all = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &all);
  for (int are_done = 0; MPI_Test(&all, &are_done, MPI_STATUS_IGNORE), !are_done;)
    usleep(1000);
  return result;
}

template <int dim>
void expect_same_run(
    const Scene<dim> &scene, const Look<dim> &look = [](const StepReport<dim> &) {})
{
  const auto alone = alone_by(
      [&](MPI_Comm communicator)
      {
        return steps_of<dim>(
            scene, [](const auto &) {}, communicator);
      });
  const auto together = steps_of<dim>(scene, look, MPI_COMM_WORLD);
  if (!is_first())
    return;
  ASSERT_EQ(alone.size(), together.size());
  for (unsigned int k = 0; k < alone.size(); ++k)
  {
    EXPECT_EQ(alone[k].n_cells, together[k].n_cells);
    EXPECT_EQ(alone[k].n_free, together[k].n_free);
    EXPECT_EQ(alone[k].n_slipping, together[k].n_slipping);
    EXPECT_EQ(alone[k].n_pressing, together[k].n_pressing);
    EXPECT_NEAR(alone[k].lagrangian, together[k].lagrangian, 1e-10 * std::abs(alone[k].lagrangian));
    EXPECT_NEAR(alone[k].estimate, together[k].estimate, 1e-8 * alone[k].estimate);
    EXPECT_EQ(alone[k].n_contact_points, together[k].n_contact_points);
  }
}

TEST(Ranks, Slab)
{
  expect_same_run(slab({{"Adaptivity/Maximum steps", "3"}}));
}

/** Of each step, in this order: energy, L2, friction, J. */
std::vector<double> true_errors(const Scene<3> &scene, MPI_Comm communicator)
{
  std::vector<double> result;
  steps_of<3>(
      scene,
      [&](const StepReport<3> &step)
      {
        const TrueErrors &errors = step.errors;
        for (const double error :
             {errors.energy, errors.l2, errors.multiplier_l2, errors.reference_energy})
          if (!std::isnan(error))
            result.push_back(error);
      },
      communicator);
  return result;
}

/** Beside a closed form, and beside finer meshes that all have computed. */
TEST(Ranks, TrueErrors)
{
  const std::string file =
      (std::filesystem::temp_directory_path() /
       ("hpvi-ranks-" + std::to_string(Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD))))
          .string();
  steps_of<3>(
      slab({given::steps("hap3", "3")}),
      [&](const StepReport<3> &step)
      {
        std::ostringstream content;
        write_solution(content, step.field, step.energies.energy);
        if (is_first())
          std::ofstream(file, std::ios::binary) << content.str();
      },
      MPI_COMM_WORLD);
  MPI_Barrier(MPI_COMM_WORLD);
  Scene<3> beside_finer = slab({given::steps("hap2", "2")});
  beside_finer.reference_solution = file;
  const Scene<3> in_closed_form = slab({{"Exact solution/Solution", "stick-slip"},
                                        {"Geometry/Lower corner", "-1, 0, 0"},
                                        given::box("1, 1, 1", "4, 2, 2"),
                                        given::elastic("1", "0.3"),
                                        {"Boundary left/Traction", ""},
                                        {"Boundary left/Displacement", "exact"},
                                        {"Boundary right/Displacement", "exact"},
                                        {"Boundary top/Displacement", "exact"},
                                        {"Boundary front/Displacement", "free; free; 0"},
                                        {"Boundary back/Displacement", "free; free; 0"},
                                        {"Boundary bottom/Friction bound", "0.3"},
                                        given::steps("hap2", "2")});
  for (const Scene<3> &scene : {beside_finer, in_closed_form})
  {
    const auto alone = alone_by([&](MPI_Comm communicator)
                                { return true_errors(scene, communicator); }),
               together = true_errors(scene, MPI_COMM_WORLD);
    if (!is_first())
      continue;
    ASSERT_EQ(alone.size(), scene.exact_solution ? 8u : 6u);
    ASSERT_EQ(together.size(), alone.size());
    for (unsigned int k = 0; k < alone.size(); ++k)
      EXPECT_NEAR(together[k], alone[k], 1e-8 * std::abs(alone[k])) << k;
  }
  if (is_first())
    std::filesystem::remove(file);
}

/** A coarsest mesh that multigrid smooths, above ML: of Coulomb's law, too. */
TEST(Ranks, CoarseMeshOfManyCells)
{
  expect_same_run(slab({{"Geometry/Subdivisions", "8, 8, 2"}, {"Adaptivity/Maximum steps", "2"}}));
  expect_same_run(slab({{"Boundary bottom/Contact", "unilateral"},
                        given::coulomb("0.6"),
                        {"Geometry/Subdivisions", "6, 6, 2"},
                        {"Adaptivity/Maximum steps", "1"}}));
}

/** Rings whose meshes do not match, on refined meshes. */
TEST(Ranks, CurvedBodies)
{
  for (const Overrides &law :
       {Overrides{{"Contact joint/Friction coefficient", "0.2"}},
        Overrides{{"Contact joint/Slave", "one.right"}},
        Overrides{{"Body other/Start degree", "3"}, {"Contact joint/Friction bound", "0.5"}}})
    expect_same_run(two_rings(2, 3,
                              law + Overrides{{"Contact joint/Gap", "-0.03"},
                                              {"Boundary other.back/Displacement", "0; 0; 0.01*x"},
                                              {"Boundary other.back/Symmetry", "false"},
                                              {"Adaptivity/Method", "hap2"},
                                              {"Adaptivity/Maximum steps", "2"}}));
}

TEST(Ranks, SlabOfDegreeThree)
{
  expect_same_run(slab({given::steps("hap3", "2")}));
}

TEST(Ranks, Plane)
{
  Scene<2> scene = read_scene<2>("prm/han-6-12.prm", Overrides{given::steps("hap3", "4")});
  scene.solver.primal_tolerance = 1e-11;
  expect_same_run(scene);
}

TEST(Ranks, UnilateralContact)
{
  for (const char *const method : {"hap2", "hap3"})
    expect_same_run(slab({given::steps(method, "2"),
                          {"Boundary bottom/Contact", "unilateral"},
                          {"Boundary bottom/Gap", "0.004*x*z"}}));
  Scene<2> scene =
      read_scene<2>("prm/han-6-12-unilateral.prm",
                    Overrides{given::steps("hap3", "4"), {"Solver/Normal contact", "multiplier"}});
  scene.solver.primal_tolerance = 1e-11;
  expect_same_run(scene);
}

TEST(Ranks, FrictionThatFollowsThePressure)
{
  for (const char *const contact : {"unilateral", "bilateral"})
    expect_same_run(slab({{"Boundary bottom/Contact", contact},
                          given::coulomb("0.6"),
                          {"Geometry/Subdivisions", "2, 2, 1"},
                          {"Adaptivity/Maximum steps", "2"}}));
}

/** Statics and springs are of all of them, as are cells that are bisected for the loads. */
TEST(Ranks, HeldByContactAlone)
{
  for (const auto &[force, steps] : {std::pair("0.5; -1; 0.1", "2"), std::pair("1; -1; 0", "1")})
  {
    Scene<3> scene =
        read_scene<3>("prm/block-space.prm", Overrides{given::box("2, 1.7, 2", "2, 1, 2"),
                                                       {"Body force/Expression", force},
                                                       {"Boundary bottom/Friction bound", "3"},
                                                       {"Boundary bottom/Friction coefficient", ""},
                                                       {"Adaptivity/Maximum steps", steps}});
    scene.solver.primal_tolerance = 1e-11;
    expect_same_run(scene);
  }
}

/** A plane of symmetry along no axis: nodes depend on themselves, of this process and of others. */
TEST(Ranks, ObliqueSymmetry)
{
  Scene<3> scene = read_scene<3>("prm/foot.prm", Overrides{{"Boundary flank/Pressure", ""},
                                                           {"Boundary flank/Symmetry", "true"},
                                                           {"Boundary top/Displacement", ""},
                                                           {"Boundary top/Traction", "0; -0.1; 0"},
                                                           given::steps("hap2", "2")});
  scene.solver.primal_tolerance = 1e-11;
  expect_same_run(scene);
}

/** Springs on refined meshes, of degree 2 and 3, by multigrid and without. */
TEST(Ranks, Springs)
{
  for (const auto &[method, steps, linear] :
       {std::tuple("hap2", "2", "multigrid"), {"hap2", "2", "direct"}, {"hap3", "1", "multigrid"}})
    expect_same_run(slab({{"Boundary right/Displacement", ""},
                          {"Boundary right/Spring", "3 + y*z; 1"},
                          {"Geometry/Subdivisions", "2, 2, 1"},
                          {"Solver/Linear", linear},
                          given::steps(method, steps)}));
}

/** Their masters are unknowns of any process: on refined meshes, of many coarse cells, and beside friction. */
TEST(Ranks, Plates)
{
  for (const auto &[method, steps, linear, cells] :
       {std::tuple("hap2", "3", "multigrid", "2, 2, 1"),
        {"hap2", "2", "direct", "2, 2, 1"},
        {"hap2", "2", "amg", "2, 2, 1"},
        {"hap2", "1", "multigrid", "6, 6, 2"}})
    expect_same_run<3>(slab({{"Boundary left/Traction", ""},
                             {"Boundary left/Rigid", "true"},
                             {"Boundary left/Displacement", "free; 0; free"},
                             {"Boundary left/Force", "6; free; 1"},
                             {"Boundary left/Rotation", "0; free; free"},
                             {"Boundary left/Moment", "free; 1; 3"},
                             {"Geometry/Subdivisions", cells},
                             {"Solver/Linear", linear},
                             given::steps(method, steps)}),
                       [](const StepReport<3> &step)
                       {
                         EXPECT_FALSE(step.primal->newton.fell_back);
                         EXPECT_NEAR(step.equilibrium.plates.at(0).moment[1], 1, 1e-8);
                         EXPECT_NEAR(step.equilibrium.plates.at(0).moment[2], 3, 1e-8);
                       });
}

TEST(Ranks, HeatAndInitialStrain)
{
  expect_same_run(slab({{"Boundary bottom/Contact", "unilateral"},
                        given::coulomb("0.6"),
                        {"Material/Initial strain", "0.01*y; 0; 0; 0.01; 0; 0.002*x"},
                        {"Material/Thermal expansion", "0.002"},
                        {"Temperature/Expression", "if(x > 2, 5 + y*z, 0)"},
                        {"Geometry/Subdivisions", "2, 2, 1"},
                        {"Adaptivity/Maximum steps", "2"}}));
}

/** Slip of the past and work go with the cells from process to process. */
TEST(Ranks, LoadHistory)
{
  const Scene<3> scene = read_scene<3>(
      "prm/slab.prm", Overrides{{"Boundary bottom/Contact", "unilateral"},
                                given::coulomb("0.6"),
                                {"Boundary left/Traction", "1.5*(5 - y)*sin(pi*t); -0.75; 0.5"},
                                {"Solver/Primal tolerance", "1e-11"},
                                {"Geometry/Subdivisions", "2, 2, 1"},
                                {"Adaptivity/Maximum steps", "2"},
                                {"Loading/Adapt", "every step"},
                                {"Material/Thermal expansion", "0.001"},
                                {"Temperature/Expression", "10*t*y"},
                                {"Loading/Steps", "2"}});
  const auto evolution = [&](MPI_Comm communicator)
  {
    std::vector<double> numbers;
    LoadHistory<3>(scene, communicator)
        .run(
            [&](const StepReport<3> &step)
            {
              EXPECT_EQ(step.primal->newton.augmented_steps, 0u); // where slip turns, too
              for (const double number :
                   {step.energies.lagrangian, step.load.work, step.load.dissipated,
                    step.load.unbalanced, step.load.stored})
                numbers.push_back(number);
            });
    return numbers;
  };
  const auto alone = alone_by(evolution), together = evolution(MPI_COMM_WORLD);
  if (!is_first())
    return;
  ASSERT_EQ(alone.size(), together.size());
  for (unsigned int k = 0; k < alone.size(); ++k)
    EXPECT_NEAR(alone[k], together[k], 1e-9 * std::abs(alone[0])) << k;
}

TEST(Ranks, MultigridOrFactorisation)
{
  Scene<3> scene = slab({{"Adaptivity/Maximum steps", "2"}});
  const auto multigrid = steps_of<3>(
      scene, [](const StepReport<3> &) {}, MPI_COMM_WORLD);
  scene.solver.linear = LinearMethod::direct;
  const auto factors = steps_of<3>(
      scene,
      [](const StepReport<3> &step)
      {
        EXPECT_LE(step.primal->newton.cg_steps, 2 * step.primal->newton.steps);
        EXPECT_FALSE(step.primal->newton.fell_back);
      },
      MPI_COMM_WORLD);
  for (unsigned int k = 0; k < factors.size(); ++k)
    EXPECT_NEAR(multigrid[k].lagrangian, factors[k].lagrangian,
                1e-10 * std::abs(factors[k].lagrangian));
}

/** A tower whose foot belongs to one process: the others have no contact at all. */
TEST(Ranks, MostWithoutContact)
{
  const Scene<3> scene = slab({given::box("1, 8, 1", "1, 8, 1"),
                               {"Boundary left/Traction", "0.2; 0; 0.1"},
                               {"Boundary bottom/Friction bound", "0.5"},
                               {"Boundary right/Displacement", ""},
                               {"Boundary top/Displacement", "0; 0; 0"},
                               {"Adaptivity/Maximum steps", "2"}});
  unsigned int without = 0;
  expect_same_run<3>(scene,
                     [&](const StepReport<3> &step) {
                       without = Utilities::MPI::sum(step.primal->space.contact.empty() ? 1U : 0U,
                                                     MPI_COMM_WORLD);
                     });
  EXPECT_GE(without + 1, Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
}

/** Whether the run of @p scene ends on all processes with what the last one says. */
bool ends_together(const Scene<3> &scene)
{
  n_reductions = 0;
  return ::failure_of<InputError>(
             [&]
             {
               steps_of<3>(
                   scene, [](const StepReport<3> &) {}, MPI_COMM_WORLD);
             }) == "found by one";
}

/** What one process alone finds out all of them say, with the same words. */
TEST(Ranks, AnErrorOnOneIsOneOnAll)
{
  Scene<3> scene = slab({{"Adaptivity/Maximum steps", "2"}});
  scene.boundary("left").traction[0] = expression<3>(std::function<double(const Point<3> &)>(
      [](const Point<3> &x) -> double
      {
        if (x[1] > 3.3 && x[1] < 3.7 && x[2] > 1.8 && x[2] < 1.95)
          throw InputError("found by one");
        return 1;
      }));
  EXPECT_TRUE(ends_together(scene));
}

/** A value that the last process cannot find between two reductions of a run. */
struct Fuse
{
  const unsigned int n = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const bool is_last = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) + 1 == n;
  std::set<unsigned int> asked;                       ///< behind which reductions
  unsigned int fatal = numbers::invalid_unsigned_int; ///< behind which it throws

  Expression<3> operator()(const double value)
  {
    return expression<3>(std::function<double(const Point<3> &)>(
        [this, value](const Point<3> &)
        {
          asked.insert(n_reductions);
          if (n_reductions == fatal && is_last)
            throw InputError("found by one");
          return value;
        }));
  }
};

/** Wherever a run asks for loads, supports, gap and friction, one process alone may fail. */
TEST(Ranks, AnErrorInAnyStageIsOneOnAll)
{
  const Overrides settings{{"Geometry/Subdivisions", "2, 1, 2"},
                           {"Boundary bottom/Contact", "unilateral"},
                           {"Adaptivity/Maximum steps", "1"}};
  Fuse fuse;
  if (fuse.n != 2)
    GTEST_SKIP() << "one that fails and one that would wait for it are enough";
  std::vector<Scene<3>> scenes(6, slab(settings)); // each with one function that may fail
  scenes[0].body_force[1] = fuse(-0.1);
  scenes[1].boundary("bottom").contact = Contact::tangential;
  scenes[1].boundary("bottom").traction[1] = fuse(1);
  scenes[2].boundary("right").displacement[1] = fuse(0);
  scenes[3].boundary("bottom").gap = fuse(0);
  scenes[4].boundary("bottom").friction.bound = fuse(4.5);
  scenes[5].initial_strains.resize(1);
  scenes[5].initial_strains[0].components[0] = fuse(0.01);
  for (const Scene<3> &scene : scenes)
  {
    fuse.asked.clear();
    fuse.fatal = numbers::invalid_unsigned_int;
    EXPECT_FALSE(ends_together(scene));
    const std::vector<unsigned int> mine(fuse.asked.begin(), fuse.asked.end());
    const auto stages = Utilities::MPI::broadcast(MPI_COMM_WORLD, mine, fuse.n - 1);
    EXPECT_GE(stages.size(), 2);
    for (const unsigned int stage : stages)
    {
      fuse.fatal = stage;
      EXPECT_TRUE(ends_together(scene)) << stage;
    }
  }
}

/** Levels are the same wherever their cells are: trees of p4est that are no coarse cells in order, refined often. */
TEST(Ranks, MultigridTakesTheSameSteps)
{
  Scene<3> scene =
      slab({{"Geometry/Subdivisions", "4, 3, 2"}, {"Adaptivity/Maximum unknowns", "20000"}});
  scene.solver.primal_tolerance = 1e-6;
  scene.solver.linear = LinearMethod::multigrid;
  const auto counts = [&](MPI_Comm communicator)
  {
    std::vector<unsigned int> steps;
    steps_of<3>(
        scene, [&](const StepReport<3> &step) { steps.push_back(step.primal->newton.cg_steps); },
        communicator);
    return steps;
  };
  const auto alone = alone_by(counts), together = counts(MPI_COMM_WORLD);
  if (!is_first())
    return;
  ASSERT_EQ(alone.size(), together.size());
  for (unsigned int k = 0; k < alone.size(); ++k)
    EXPECT_NEAR(alone[k], together[k], 1) << k;
}

/** Of each unknown that a process sees; entries of both are sorted by close(). */
TEST(Ranks, HangingNodesAreConstrainedAsByDealII)
{
  const auto compare = [](const StepReport<3> &step)
  {
    const PrimalSpace<3> &space = step.primal->space;
    AffineConstraints<double> ours(space.relevant), theirs(space.relevant);
    for (AffineConstraints<double> *const constraints : {&ours, &theirs})
      DoFTools::make_hanging_node_constraints(space.dof_handler, *constraints);
    make_consistent(ours, space.owned, space.relevant, space.communicator());
    theirs.make_consistent_in_parallel(space.owned, space.relevant, space.communicator());
    theirs.close();
    unsigned int n_hanging = 0;
    for (const auto i : space.relevant)
    {
      ASSERT_EQ(ours.is_constrained(i), theirs.is_constrained(i));
      if (!ours.is_constrained(i))
        continue;
      ++n_hanging;
      const auto &a = *ours.get_constraint_entries(i), &b = *theirs.get_constraint_entries(i);
      ASSERT_EQ(a.size(), b.size());
      for (unsigned int k = 0; k < a.size(); ++k)
      {
        EXPECT_EQ(a[k].first, b[k].first);
        EXPECT_NEAR(a[k].second, b[k].second, 1e-14);
      }
    }
    EXPECT_TRUE(step.number == 1 || Utilities::MPI::sum(n_hanging, MPI_COMM_WORLD) > 0);
  };
  steps_of<3>(slab({{"Adaptivity/Maximum steps", "4"}}), compare, MPI_COMM_WORLD);
}

TEST(Ranks, MoreThanCells)
{
  const unsigned int n = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const Scene<3> scene = slab({{"Geometry/Subdivisions", "1, 1, 1"}});
  if (n == 1)
    GTEST_SKIP() << "one process never is more than the cells";
  EXPECT_THROW(AdaptiveSolver<3>(scene, MPI_COMM_WORLD), InputError);
}
} // namespace

#undef MPI_Allreduce // PETSc counts with a macro

/** MPI's own is PMPI_Allreduce. */
extern "C" int MPI_Allreduce(const void *send, void *receive, int count, MPI_Datatype type,
                             MPI_Op operation, MPI_Comm communicator)
{
  ++n_reductions;
  return PMPI_Allreduce(send, receive, count, type, operation, communicator);
}

int main(int argc, char *argv[])
{
  ::testing::InitGoogleTest(&argc, argv);
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return RUN_ALL_TESTS();
}
