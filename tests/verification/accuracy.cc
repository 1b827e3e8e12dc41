// SPDX-License-Identifier: LGPL-2.1-or-later
// True errors, stored reference solutions, and the limits that stop a run.
#include "discretisation.h"

#include <hpvi/results/solution_field.h>

#include <deal.II/base/quadrature_lib.h>

namespace
{
using namespace verification;

/** What the tests want to know of each step of a run. */
struct Row
{
  unsigned int n;
  double relative, scaled, seconds, energy;
  TrueErrors errors;
  std::string stopped_by;
};

std::vector<Row> rows_of(const Scene<2> &scene)
{
  std::vector<Row> rows;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        rows.push_back({step.solution().displacement_space.n_free_dofs(), step.relative_estimate,
                        step.scaled_estimate, step.seconds, step.energies.energy, step.errors,
                        text(step.stopped_by)});
      });
  return rows;
}

double last_rate(const std::vector<Row> &rows)
{
  const Row &a = rows[rows.size() - 2], &b = rows.back();
  return std::log(a.errors.energy / b.errors.energy) / std::log(double(b.n) / a.n);
}

Overrides adaptivity(const std::string &method, const unsigned int steps)
{
  return {given::steps(method, std::to_string(steps))};
}

// ---------------------------------------------------------------- closed forms

TEST(TrueError, UniformBisectionIsLimitedByTheTransition)
{
  // u ~ r^{3/2} at the transition: rate 3/4 in N for every degree
  for (const std::string method : {"hup2", "hup3"})
    EXPECT_NEAR(last_rate(rows_of(shipped_scene("stick-slip", adaptivity(method, 5)))), 0.75, 0.05)
        << method;
}

TEST(TrueError, NormOfTheExactSolution)
{
  const auto rows = rows_of(shipped_scene("stick-slip", adaptivity("hup2", 2)));
  EXPECT_NEAR(rows.back().errors.energy_norm, std::sqrt(0.37710185557), 1e-9);
}

/**
 * The errors of no displacement at all are norms of the exact solution: |lambda|^2 of stick-slip is
 * 1 where it slips and `int (1 - sqrt(x))^2 = 1/6` where it sticks.
 */
TEST(TrueError, OfNothingIsTheNormOfTheExactSolution)
{
  const Scene<2> scene = shipped_scene("stick-slip");
  const RandomMesh mesh(scene, 1, 1);
  const Laboratory discrete(scene, mesh);
  const Solution<2> nothing{scene, discrete.spaces,
                            Vector<double>(discrete.displacement_space.n_dofs()),
                            Vector<double>(discrete.contact_space.n_multipliers())};
  double square = 0;
  const QIterated<1> gauss(QGauss<1>(6), 40);
  for (unsigned int i = 0; i < gauss.size(); ++i)
    for (unsigned int j = 0; j < gauss.size(); ++j)
    {
      const Point<2> x(2 * gauss.point(i)[0] - 1, gauss.point(j)[0]);
      square += 2 * gauss.weight(i) * gauss.weight(j) *
                scene.exact_solution->displacement(x).norm_square();
    }
  const TrueErrors errors =
      TrueError<2>(scene).measure(SolutionField(nothing), contact_states(SolutionField(nothing)));
  EXPECT_NEAR(errors.energy, std::sqrt(0.37710185557), 1e-9);
  EXPECT_NEAR(errors.l2, std::sqrt(square), 1e-8);
  EXPECT_NEAR(errors.multiplier_l2, std::sqrt(7. / 6), 1e-9);
  EXPECT_TRUE(std::isnan(errors.transition)); // it sticks everywhere
}

/** Four edges with two Gauss points each: the middle between those beside x = 0 is 0. */
/** One cell of 1:256 and 256 square ones: the norm of the exact solution is the same, near singular points too. */
TEST(TrueError, OnLongCellsIsThatOnSquareOnes)
{
  std::vector<double> norms;
  for (const char *const subdivisions : {"4, 1", "4, 256"})
    each_step<2>(shipped_scene("partial-slip", {given::box("2, 256", subdivisions),
                                                {"Adaptivity/Maximum steps", "1"}}),
                 [&](const StepReport<2> &step) { norms.push_back(step.errors.energy_norm); });
  ASSERT_EQ(norms.size(), 2u);
  EXPECT_NEAR(norms[0], norms[1], 1e-9 * norms[1]);
}

TEST(TrueError, OfTheTransitionIsADistance)
{
  const Scene<2> scene = shipped_scene("stick-slip", {{"Exact solution/Transition", "0.1"}});
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  const Laboratory discrete(scene, mesh, Degrees(mesh.n_active_cells(), 3));
  Vector<double> z(discrete.contact_space.n_multipliers());
  ASSERT_EQ(z.size(), 8U);
  for (unsigned int i = 0; i < 4; ++i)
    z[i] = discrete.contact_space.largest_bound();
  const Solution<2> solution{scene, discrete.spaces,
                             Vector<double>(discrete.displacement_space.n_dofs()), z};
  EXPECT_NEAR(TrueError<2>(scene)
                  .measure(SolutionField(solution), contact_states(SolutionField(solution)))
                  .transition,
              0.1, 1e-14);
}

TEST(TrueError, PureDegreeConvergesExponentiallyOnASmoothField)
{
  const auto rows = rows_of(shipped_scene("smooth"));
  ASSERT_GE(rows.size(), 9U);
  for (unsigned int k = 1; k < 8; ++k) // each degree brings at least a factor 4
    EXPECT_LT(rows[k].errors.energy, rows[k - 1].errors.energy / 4) << "step " << k + 1;
}

TEST(TrueError, HpAdaptivityIsExponentialWhereverTheTransitionLies)
{
  for (const std::string transition : {"0", "0.1"})
  {
    Overrides overrides = adaptivity("hpa3", 60);
    overrides.emplace_back("Adaptivity/Maximum unknowns", "9000");
    overrides.emplace_back("Exact solution/Transition", transition);
    const auto rows = rows_of(shipped_scene("stick-slip", overrides));
    bool reached = false;
    for (const Row &row : rows)
      reached = reached || (row.errors.energy <= 1e-6 && row.n < 6000);
    EXPECT_TRUE(reached) << "c = " << transition;
    EXPECT_LT(rows.back().errors.multiplier_l2, 1e-2);
    EXPECT_LT(rows.back().errors.transition, 1e-2);
  }
}

TEST(TrueError, FewUnknownsForAMillionth)
{
  for (const Row &row : rows_of(shipped_scene("stick-slip")))
    if (row.errors.energy <= 1e-6)
    {
      EXPECT_LT(row.n, 4500U);
      return;
    }
  FAIL() << "1e-6 is never reached";
}

/** J(u_N) - J(u) = 1/2 |u-u_N|_a^2 + slack, where u_N meets the Dirichlet data well enough. */
TEST(TrueError, EnergyDifferenceObeysItsIdentity)
{
  each_step<2>(shipped_scene("stick-slip", adaptivity("hpa3", 14)),
               [](const StepReport<2> &step)
               {
                 const double half_square = 0.5 * std::pow(step.errors.energy, 2);
                 const double expected = half_square + step.energies.slack;
                 const double difference = step.energies.energy - step.errors.reference_energy;
                 EXPECT_NEAR(difference, expected, 1e-3 * expected + half_square) << step.number;
               });
}

/** Here loads work, too: those of the top edge. */
TEST(TrueError, EnergyTendsToThatOfTheExactSolution)
{
  each_step<2>(shipped_scene("smooth", {{"Adaptivity/Maximum steps", "9"}}),
               [](const StepReport<2> &step)
               {
                 const double bound = 1e-9 + step.errors.energy * step.errors.energy_norm;
                 EXPECT_NEAR(step.energies.energy, step.errors.reference_energy, bound)
                     << step.number;
               });
}

/** Far below what users ask for: no stage may lose digits that its successors need. */
TEST(TrueError, FallsToRoundOffWithTheIndicator)
{
  const auto rows = rows_of(shipped_scene(
      "stick-slip", {{"Adaptivity/Maximum degree", "14"}, {"Adaptivity/Maximum steps", "20"}}));
  EXPECT_LT(rows.back().errors.energy, 2e-10 * rows.back().errors.energy_norm);
  for (unsigned int k = 8; k < rows.size(); ++k)
  {
    EXPECT_LT(rows[k].errors.energy, rows[k - 1].errors.energy);
    EXPECT_GT(rows[k].scaled, 2 * rows[k].errors.energy);
  }
}

TEST(TrueError, EffectivityIsNearlyConstant)
{
  for (const Row &row : rows_of(shipped_scene("stick-slip", adaptivity("hpa3", 14))))
  {
    EXPECT_GT(row.scaled / row.errors.energy, 1.);
    EXPECT_LT(row.scaled / row.errors.energy, 10.);
  }
}

// ---------------------------------------------------------------- reference solutions

TEST(StoredSolution, ASolutionHasNoDistanceFromItself)
{
  const ReferenceFile file(shipped_scene("han-6-12", adaptivity("hpa2", 6)));
  Overrides overrides = adaptivity("hpa2", 6);
  overrides.emplace_back("Error/Reference solution", file.path);
  const auto rows = rows_of(shipped_scene("han-6-12", overrides));
  EXPECT_LT(rows.back().errors.energy, 1e-12 * rows.back().errors.energy_norm);
  EXPECT_GT(rows.front().errors.energy, 1e-3);
  EXPECT_EQ(rows.back().errors.reference_energy, rows.back().energy);
}

TEST(StoredSolution, MeasuresWhatTheExactSolutionMeasures)
{
  const ReferenceFile file(shipped_scene("stick-slip", adaptivity("hpa3", 16)));
  const auto exact = rows_of(shipped_scene("stick-slip", adaptivity("hup3", 4)));
  // Without the exact solution's section the scene would need its boundary data: keep it, and
  // compare the stored field directly.
  const Scene<2> scene = shipped_scene("stick-slip", adaptivity("hup3", 4));
  Scene<2> other = scene;
  other.exact_solution = nullptr;
  other.reference_solution = file.path;
  const auto stored = rows_of(other);
  for (unsigned int k = 0; k < exact.size(); ++k)
  {
    EXPECT_NEAR(stored[k].errors.energy, exact[k].errors.energy, 1e-3 * exact[k].errors.energy);
    EXPECT_NEAR(stored[k].errors.l2, exact[k].errors.l2, 1e-3 * exact[k].errors.l2);
  }
}

/** Without friction the spaces are nested and Pythagoras holds: |u - u_N|^2 = |u|^2 - |u_N|^2. */
TEST(StoredSolution, ObeysPythagoras)
{
  const auto without_friction = [](const std::string &degree) {
    return Overrides{{"Boundary bottom/Friction bound", ""}, given::steps("hup2", "1", degree)};
  };
  const ReferenceFile file(shipped_scene("han-6-12", without_friction("9")));
  for (const std::string degree : {"2", "5"})
  {
    Overrides overrides = without_friction(degree);
    overrides.emplace_back("Error/Reference solution", file.path);
    each_step<2>(
        shipped_scene("han-6-12", overrides),
        [&](const StepReport<2> &step)
        {
          const double norm = step.errors.energy_norm, own = step.energies.norm;
          const double expected = norm * norm - own * own;
          EXPECT_NEAR(step.errors.energy * step.errors.energy, expected, 1e-9 * norm * norm)
              << degree;
          EXPECT_GT(expected, 1e-5 * norm * norm);
        });
  }
}

/** deal.II's CellId ends at 30 levels; a reference that closes in on a transition goes deeper. */
TEST(StoredSolution, KeepsCellsOfAnyDepth)
{
  const Overrides overrides = {{"Adaptivity/Maximum steps", "1"},
                               given::graded("Geometry", "0, 0", "36")};
  const ReferenceFile file(shipped_scene("stick-slip", overrides));
  Scene<2> scene = shipped_scene("stick-slip", overrides);
  scene.exact_solution = nullptr;
  scene.reference_solution = file.path;
  const auto rows = rows_of(scene);
  EXPECT_GT(rows.back().errors.energy_norm, 0.6);
  EXPECT_LT(rows.back().errors.energy, 1e-12);
}

TEST(StoredSolution, RejectsWhatDoesNotFit)
{
  const ReferenceFile file(shipped_scene("han-6-13", adaptivity("hup2", 2)));
  Overrides overrides = adaptivity("hup2", 2);
  overrides.emplace_back("Error/Reference solution", file.path);
  const Scene<2> other = shipped_scene("han-6-12", overrides);
  EXPECT_THROW(AdaptiveSolver<2>{other}, InputError);

  std::filesystem::resize_file(file.path, std::filesystem::file_size(file.path) / 2);
  const Scene<2> same = shipped_scene("han-6-13", overrides);
  EXPECT_THROW(AdaptiveSolver<2>{same}, InputError);
}

// ---------------------------------------------------------------- limits

TEST(Limits, EachStopsTheRunAndSaysSo)
{
  const auto stop = [](const Overrides &overrides)
  { return rows_of(shipped_scene("han-6-12", overrides)); };

  auto rows = stop({{"Adaptivity/Maximum steps", "3"}});
  EXPECT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows.back().stopped_by, "Maximum steps");

  rows = stop({{"Adaptivity/Maximum unknowns", "1000"}});
  EXPECT_EQ(rows.back().stopped_by, "Maximum unknowns");
  EXPECT_GE(rows.back().n, 1000U);
  EXPECT_LT(rows[rows.size() - 2].n, 1000U);

  rows = stop({{"Adaptivity/Tolerance", "0.01"}, {"Adaptivity/Tolerance on", "residual"}});
  EXPECT_EQ(rows.back().stopped_by, "Tolerance");
  EXPECT_LT(rows.back().relative, 0.01);
  EXPECT_GE(rows[rows.size() - 2].relative, 0.01);

  rows = stop({{"Adaptivity/Maximum seconds", "1e-6"}});
  EXPECT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows.back().stopped_by, "Maximum seconds");

  rows = stop({{"Adaptivity/Method", "pu"}, {"Adaptivity/Maximum degree", "4"}});
  EXPECT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows.back().stopped_by, "Maximum degree");
}

/** The tolerance of a scene in which something holds the body. */
template <int dim>
Adaptivity limits(const Overrides &more, const SceneUse use = SceneUse::solve)
{
  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("hpvi-" + std::to_string(std::random_device()()) + ".prm");
  std::ofstream(file) << "set Dimension = " << dim << '\n';
  Overrides entries = {{"Boundary bottom/Displacement", dim == 2 ? "0; 0" : "0; 0; 0"}};
  entries.insert(entries.end(), more.begin(), more.end());
  const Adaptivity result = read_scene<dim>(file.string(), entries, use).adaptivity;
  std::filesystem::remove(file);
  return result;
}

TEST(Limits, ATakenToleranceIsTheOnlyOne)
{
  for (const Overrides &none :
       {Overrides{}, Overrides{{"Adaptivity/Tolerance", "automatic"}},
        Overrides{{"Adaptivity/Method", "hup2"}, {"Adaptivity/Maximum degree", "5"}}})
  {
    EXPECT_EQ(limits<2>(none).tolerance, 1e-3);
    EXPECT_TRUE(limits<2>(none).is_default_tolerance);
    EXPECT_EQ(limits<2>(none).tolerance_on, Indicator::bound);
  }
  EXPECT_EQ(limits<3>({}).tolerance, 1e-3);
  EXPECT_EQ(limits<3>({}).tolerance_on, Indicator::residual);
  EXPECT_EQ(limits<2>({{"Solver/Path", "primal"}, {"Adaptivity/Method", "hup2"}}).tolerance_on,
            Indicator::residual);
  const ReferenceFile other(shipped_scene("han-6-12", adaptivity("hup2", 1)));
  for (const auto &named : Overrides{{"Adaptivity/Maximum steps", "16"},
                                     {"Adaptivity/Maximum unknowns", "1000000"},
                                     {"Adaptivity/Maximum seconds", "0"},
                                     {"Loading/Steps", "2"},
                                     {"Output/Reference solution", "true"},
                                     {"Error/Reference solution", other.path}})
    for (const char *const value : {"", "automatic"})
    {
      Overrides entries = {named};
      if (*value != '\0')
        entries.push_back({"Adaptivity/Tolerance", value});
      EXPECT_EQ(limits<2>(entries).tolerance, 0) << named.first;
      EXPECT_FALSE(limits<2>(entries).is_default_tolerance) << named.first;
    }
  EXPECT_EQ(limits<2>({}, SceneUse::measure).tolerance, 0);
  EXPECT_EQ(limits<2>({{"Adaptivity/Tolerance", "0.001"}}).is_default_tolerance, false);
  EXPECT_EQ(limits<2>({{"Adaptivity/Tolerance", "0"}}).tolerance, 0);
  EXPECT_EQ(Scene<2>().adaptivity.tolerance, 0);
  EXPECT_EQ(scene_of({{"Exact solution/Solution", "smooth"},
                      {"Geometry/Lower corner", "-1, 0"},
                      {"Boundary left/Displacement", "exact"},
                      {"Boundary right/Displacement", "exact"},
                      {"Boundary top/Traction", "exact"},
                      given::rough("bottom", "bilateral", "0.1")})
                .adaptivity.tolerance,
            0);
}

TEST(Limits, SecondsAreThoseOfAllStepsSoFar)
{
  double sum = 0;
  each_step<2>(shipped_scene("han-6-12", {{"Adaptivity/Maximum steps", "4"}}),
               [&](const StepReport<2> &step)
               {
                 sum += step.times.total();
                 EXPECT_GT(step.times.total(), 0.);
                 EXPECT_NEAR(step.seconds, sum, 1e-12);
               });
}
} // namespace
