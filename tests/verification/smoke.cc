// SPDX-License-Identifier: LGPL-2.1-or-later
// Whole runs that write every file, short enough for a Debug build: there deal.II's assertions speak.
#include "discretisation.h"

#include <hpvi/driver/load_history.h>
#include <hpvi/output/output.h>
#include <hpvi/results/inf_sup.h>

#include <algorithm>
#include <map>
#include <memory>
#include <ostream>

namespace
{
using namespace verification;
namespace fs = std::filesystem;

/** A directory for the time of a test. */
class Directory
{
public:
  const fs::path path =
      fs::path(::testing::TempDir()) / ("hpvi-smoke-" + std::to_string(std::random_device()()));

  ~Directory()
  {
    fs::remove_all(path);
  }
};

/** Solve, and write what a run of the program writes. */
template <int dim>
void run(const Scene<dim> &scene, const fs::path &directory)
{
  Output<dim> output(scene, directory.string());
  std::string last;
  const auto write = [&](const StepReport<dim> &step)
  {
    output.write_step(step);
    last = (step.number < 10 ? "-0" : "-") + std::to_string(step.number);
    EXPECT_GT(step.energies.norm, 0.);
  };
  if (scene.has_load_history())
    LoadHistory<dim>(scene).run(write);
  else
    AdaptiveSolver<dim>(scene).run(write);
  output.finish();
  const std::vector<std::string> names = {"solution" + last + ".vtu",
                                          "convergence.csv",
                                          "degrees.csv",
                                          "forces.csv",
                                          "scene.prm",
                                          "summary.json"};
  for (const std::string &name : names)
    EXPECT_GT(fs::file_size(directory / name), 20U) << name;
  EXPECT_EQ(fs::exists(directory / ("contact" + last + ".csv")), scene.has_contact());
}

struct Case
{
  std::string name, scene;
  Overrides overrides;
};

std::ostream &operator<<(std::ostream &out, const Case &item)
{
  return out << item.name;
}

std::vector<Case> cases()
{
  std::vector<Case> result;
  for (const std::string method :
       {"hap2", "pu", "hpa1", "hpa3", "hpa4"}) // others have no code of their own
    result.push_back(
        {method, "han-6-12", {{"Adaptivity/Method", method}, {"Adaptivity/Start degree", "0"}}});
  result.push_back({"bar", "han-6-13", {}});
  result.push_back({"stick_slip", "stick-slip", {{"Exact solution/Transition", "0.1"}}});
  result.push_back({"plane_strain", "plane-strain", {}});
  result.push_back({"smooth", "smooth", {}});
  result.push_back({"semicoercive", "semicoercive", {}});
  result.push_back({"mprgp",
                    "han-6-12",
                    {{"Solver/QP solver", "mprgp"},
                     {"Solver/QP warm start", "false"},
                     {"Solver/Diagonal scaling", "false"},
                     {"Solver/Condition number", "true"}}});
  result.push_back({"rich_multiplier", "han-6-12", {{"Solver/Multiplier degree offset", "-1"}}});
  result.push_back({"no_friction", "han-6-12", {{"Boundary bottom/Friction bound", "0"}}});
  result.push_back({"no_contact",
                    "han-6-12",
                    {{"Boundary bottom/Contact", "none"},
                     {"Boundary bottom/Friction bound", ""},
                     {"Body force/Expression", "0; -x"}}});
  result.push_back({"graded", "han-6-12", {given::graded("Geometry", "1, 0; 4, 0", "3")}});
  result.push_back({"quadrilateral",
                    "han-6-12",
                    {given::quadrilateral("Geometry", "0, 0; 4, 0.5; 3.5, 4; -0.5, 3.5"),
                     {"Geometry/Lower corner", "0, 0"},
                     {"Geometry/Upper corner", "1, 1"},
                     {"Body force/Expression", "x*y; 1"}}});
  result.push_back({"distorted_with_bound",
                    "han-6-12",
                    {given::quadrilateral("Geometry", "0, 0; 4, 0; 3.5, 4; -0.5, 3.5", "2, 2"),
                     {"Geometry/Lower corner", "0, 0"},
                     {"Geometry/Upper corner", "1, 1"},
                     {"Adaptivity/Method", "hup2"},
                     {"Adaptivity/Start degree", "2"},
                     {"Error/Bound", "true"}}});
  result.push_back(
      {"two_contacts", "han-6-12", {given::rough("top", "bilateral", "if(x < 2, 0, 1 + x)")}});
  for (const std::string scene : {"hertz", "resting"})
    for (const std::string normal : {"nodes", "multiplier"})
      result.push_back({scene + "_" + normal, scene, {{"Solver/Normal contact", normal}}});
  result.push_back({"coulomb", "ssnv128", {}});
  result.push_back({"coulomb_fixed_point", "ssnv128", {{"Solver/Coulomb solver", "fixed point"}}});
  result.push_back({"coulomb_bilateral", "ssnv128", {{"Boundary bottom/Contact", "bilateral"}}});
  result.push_back({"slanted_unilateral",
                    "han-6-12-unilateral",
                    {given::quadrilateral("Geometry", "0, 0; 4, 0.5; 3.5, 4; -0.5, 3.5"),
                     {"Geometry/Lower corner", "0, 0"},
                     {"Geometry/Upper corner", "1, 1"},
                     {"Boundary left/Traction", ""},
                     {"Boundary left/Contact", "unilateral"},
                     {"Boundary left/Gap", "-0.01"},
                     {"Solver/QP solver", "mprgp"}}});
  for (const std::string scene :
       {"partial-slip", "slope", "punch-limited", "strut", "blocks", "glued", "punch-plate",
        "sleeve", "ballast", "bimetal", "spruce", "plate-hole", "shrink-fit", "bracket",
        "retaining", "askew", "propped", "thermal-joint"})
  {
    std::string name = scene;
    std::replace(name.begin(), name.end(), '-', '_');
    result.push_back({name, scene, {{"Adaptivity/Maximum steps", "2"}}});
  }
  result.push_back(
      {"history", "fretting", {{"Adaptivity/Maximum steps", "2"}, {"Loading/Steps", "4"}}});
  return result;
}

using EveryKind = ::testing::TestWithParam<Case>;

TEST_P(EveryKind, RunsAndWrites)
{
  const Directory directory;
  run(shipped_scene(GetParam().scene,
                    Overrides{{"Adaptivity/Maximum steps", "3"}} + GetParam().overrides),
      directory.path);
}

INSTANTIATE_TEST_SUITE_P(, EveryKind, ::testing::ValuesIn(cases()),
                         [](const auto &info) { return info.param.name; });

/** Once a process, for the tests that ask for it. */
class Mpi : public ::testing::Environment
{
public:
  void start()
  {
    int n_arguments = 0;
    char **arguments = nullptr;
    if (!mpi)
      mpi = std::make_unique<Utilities::MPI::MPI_InitFinalize>(n_arguments, arguments, 1);
  }
  void TearDown() override
  {
    mpi.reset();
  }

private:
  std::unique_ptr<Utilities::MPI::MPI_InitFinalize> mpi;
};

Mpi *const mpi = dynamic_cast<Mpi *>(::testing::AddGlobalTestEnvironment(new Mpi));

TEST(Smoke, BodiesInSpace)
{
  mpi->start();
  for (const auto &[name, steps] :
       std::map<std::string, std::string>{{"slab", "2"}, {"foot", "1"}, {"block-space", "1"}})
  {
    SCOPED_TRACE(name);
    const Directory directory;
    run(read_scene<3>("prm/" + name + ".prm", {{"Adaptivity/Maximum steps", steps}}),
        directory.path);
  }
}

TEST(Smoke, ReferencesAreWrittenAndRead)
{
  const Directory first, second;
  const Overrides steps = {{"Adaptivity/Maximum steps", "3"},
                           {"Output/Reference solution", "true"}};
  run(shipped_scene("han-6-12", steps), first.path);
  run(shipped_scene("han-6-12",
                    {{"Adaptivity/Maximum steps", "2"},
                     {"Error/Reference solution", (first.path / "reference.dat").string()}}),
      second.path);
}

TEST(Smoke, InfSup)
{
  const Scene<2> scene = shipped_scene("han-6-13");
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  const InfSup result = measure_inf_sup(scene, mesh, Degrees(mesh.n_active_cells(), 3));
  EXPECT_GT(result.beta, 0.5);
}

TEST(Smoke, InfSupOfPressureAndFriction)
{
  for (const std::string normal : {"nodes", "multiplier"})
  {
    const Scene<2> scene = shipped_scene("resting", {{"Solver/Normal contact", normal}});
    Triangulation<2> mesh;
    make_mesh(scene, mesh);
    const InfSup result = measure_inf_sup(scene, mesh, Degrees(mesh.n_active_cells(), 4));
    EXPECT_GT(result.beta, 0.5) << normal;
  }
}

/** Whether this build would notice at all. */
TEST(Smoke, AssertionsEndADebugBuild)
{
#ifdef DEBUG
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const Vector<double> empty;
  EXPECT_DEATH(EXPECT_EQ(empty(0), 0.), "An error occurred");
  const std::vector<double> none;
  EXPECT_DEATH(EXPECT_EQ(none[0], 0.), "Assertion");
#else
  GTEST_SKIP() << "no Debug build";
#endif
}
} // namespace
