// SPDX-License-Identifier: LGPL-2.1-or-later
// Loads that are narrow, jump or bend: their rules, what is said where no rule resolves them, and the bound of the error
// under them.
#include "discretisation.h"

#include <hpvi/bound/test_motion.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/plane/mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>

namespace
{
using namespace hpvi;
using dealii::Point;
using dealii::Tensor;

using Function = std::function<double(const Point<2> &)>;

Scene<2> body(const Point<2> &upper, const std::array<unsigned int, 2> &subdivisions)
{
  Scene<2> scene;
  scene.geometry.corners = box_corners(Point<2>(), upper);
  scene.geometry.subdivisions = subdivisions;
  scene.materials[0].young = 1000;
  scene.materials[0].poisson = 0.3;
  return scene;
}

void hold(Scene<2> &scene, const std::string &boundary)
{
  scene.boundary(boundary).displacement = {{expression<2>(0.), expression<2>(0.)}};
}

/** A strip of 100 x 20 on friction, its bottom bilateral. */
Scene<2> strip(const unsigned int n_cells)
{
  Scene<2> scene = body({100., 20.}, {{n_cells, 1}});
  scene.boundary("bottom").contact = Contact::bilateral;
  scene.boundary("bottom").friction.bound = expression<2>(0.5);
  return scene;
}

struct Mesh
{
  dealii::Triangulation<2> mesh;
  std::shared_ptr<const ShapeTables<2>> tables = std::make_shared<const ShapeTables<2>>();
  const LoadRules<2> rules;

  explicit Mesh(const Scene<2> &scene) : rules((make_mesh(scene, mesh), scene), mesh, tables)
  {
  }

  /** Cells that hold one of the points, so often. */
  void bisect(const std::vector<Point<2>> &points, const unsigned int times)
  {
    for (unsigned int k = 0; k < times; ++k)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        for (const Point<2> &x : points)
          if (cell->bounding_box().point_inside(x))
            cell->set_refine_flag();
      mesh.execute_coarsening_and_refinement();
    }
  }
};

/** int f along the top of all active cells, by the rules of the traction there. */
double along_top(const Scene<2> &scene, const Mesh &mesh, const Function &f)
{
  double sum = 0;
  for (const auto &cell : mesh.mesh.active_cell_iterators())
    if (cell->at_boundary(3))
    {
      const CellMap<2> map = map_of<2>(cell);
      const LoadRule<1> rule = mesh.rules.traction(cell, 3, scene.adaptivity.start_degree);
      for (unsigned int q = 0; q < rule.quadrature.size(); ++q)
        sum += rule.quadrature.weight(q) * cell->face(3)->measure() *
               f(map.point(point_on_face<2>(3, rule.quadrature.point(q))));
    }
  return sum;
}

double inside(const Scene<2> &scene, const Mesh &mesh, const Function &f)
{
  double sum = 0;
  for (const auto &cell : mesh.mesh.active_cell_iterators())
  {
    const CellMap<2> map = map_of<2>(cell);
    const LoadRule<2> rule = mesh.rules.body_force(cell, scene.adaptivity.start_degree);
    for (unsigned int q = 0; q < rule.quadrature.size(); ++q)
    {
      const Point<2> &s = rule.quadrature.point(q);
      sum += rule.quadrature.weight(q) * determinant(map.jacobian(s)) * f(map.point(s));
    }
  }
  return sum;
}

// ---------------------------------------------------------------- rules

TEST(CutRule, LooksAsCloselyAsItIsAsked)
{
  const dealii::QGauss<1> gauss(5);
  const auto bump = [](const double s) { return std::abs(s - 0.4) < 0.01 ? 1. : 0.; };
  const CutRule coarse = make_cut_rule(bump, gauss, {0, 1, 2}),
                fine = make_cut_rule(bump, gauss, {0, 1, 2}, 64);
  EXPECT_EQ(coarse.integral(), 0.); // between all points
  EXPECT_NEAR(fine.integral(), 0.02, 1e-15);
  EXPECT_EQ(fine.jumps.size(), 2U);
  EXPECT_LT(fine.deviation, 1e-12);
}

TEST(CutRule, TellsHowWellItIntegrates)
{
  const auto noise = [](const double s) { return std::sin(1e6 * s * s); };
  const CutRule rule = make_cut_rule(noise, dealii::QGauss<1>(5), {0, 1, 2});
  EXPECT_GT(rule.deviation, 1e-3);
  EXPECT_NE(rule.integral(), rule.finer_integral);
}

TEST(LoadRules, FindNarrowTractionsWhereverTheyAre)
{
  for (const unsigned int n_cells : {1, 4})
    for (const double at : {3., 11.1, 25., 31., 40., 47.3, 50., 62.5, 75., 96.})
    {
      const Function load = [at](const Point<2> &x)
      { return -1 - 50. * (std::abs(x[0] - at) < 1); };
      Scene<2> scene = strip(n_cells);
      scene.boundary("top").traction[1] = expression<2>(load);
      Mesh mesh(scene);
      EXPECT_TRUE(mesh.rules.unresolved(mesh.mesh).empty());
      EXPECT_LT(mesh.rules.difference(Datum::load), 1e-11);
      const LoadSum &sum = mesh.rules.sum();
      EXPECT_NEAR(sum.force[1], -200, 1e-9) << at;
      EXPECT_NEAR(sum.moment, -100 * (at - 50), 1e-8) << at;
      EXPECT_NEAR(sum.absolute, 200, 1e-9) << at;
      for (unsigned int k = 0; k < 3; ++k, mesh.bisect({{at, 20.}, {at / 2, 20.}}, 1))
      {
        EXPECT_NEAR(along_top(scene, mesh, load), -200, 1e-9) << at << ", bisected " << k;
        const auto moment = [&](const Point<2> &x) { return (x[0] - 50) * load(x); };
        EXPECT_NEAR(along_top(scene, mesh, moment), -100 * (at - 50), 1e-8) << at;
      }
    }
}

TEST(LoadRules, LeaveSmoothLoadsAlone)
{
  Scene<2> scene = strip(4);
  scene.boundary("top").traction[1] =
      expression<2>([](const Point<2> &x) { return std::cos(0.02 * x[0]); });
  scene.body_force[0] = expression<2>([](const Point<2> &x) { return x[0] * x[1]; });
  scene.boundary("left").displacement[0] =
      expression<2>([](const Point<2> &x) { return std::exp(0.1 * x[1]); });
  const Mesh mesh(scene);
  const unsigned int p = scene.adaptivity.start_degree;
  for (const auto &cell : mesh.mesh.active_cell_iterators())
  {
    EXPECT_EQ(mesh.rules.traction(cell, 3, p).n_gauss, p + 6);
    EXPECT_EQ(mesh.rules.traction(cell, 3, p).cuts.size(), 2U);
    EXPECT_EQ(mesh.rules.body_force(cell, p).n_gauss, p + 2);
    EXPECT_TRUE(mesh.rules.displacement_points(cell, 0).empty());
  }
}

/** Near its zero the round-off of (1 - y)^2 is large beside its values: it takes no more points than elsewhere. */
TEST(LoadRules, SpendNoPointsOnRoundOff)
{
  Scene<2> scene = body({1., 1.}, {{1, 1}});
  scene.body_force[0] =
      expression<2>([](const Point<2> &x) { return -2e-3 * std::pow(1 - x[1], 2); });
  Mesh mesh(scene);
  mesh.bisect({{0.01, 0.999999}}, 14);
  for (const auto &cell : mesh.mesh.active_cell_iterators())
    EXPECT_LE(mesh.rules.body_force(cell, 4).most_points, 14U) << cell->center();
}

TEST(LoadRules, CutCellsAtJumpsAlongTheirAxes)
{
  const Function load = [](const Point<2> &x) { return x[0] < 31.7 && x[1] > 4.2 ? x[1] : 0.; };
  Scene<2> scene = strip(4);
  scene.body_force[1] = expression<2>(load);
  Mesh mesh(scene);
  EXPECT_TRUE(mesh.rules.unresolved(mesh.mesh).empty());
  const double exact = 31.7 * (400 - 4.2 * 4.2) / 2;
  EXPECT_NEAR(mesh.rules.sum().force[1], exact, 1e-9 * exact);
  mesh.bisect({{31., 5.}}, 3);
  EXPECT_NEAR(inside(scene, mesh, load), exact, 1e-9 * exact);
}

TEST(LoadRules, SeeASpotOfBodyForceAndSayThatItIsNotResolved)
{
  for (const unsigned int n_cells : {1, 4})
    for (const double at : {13., 40., 88.})
    {
      const Function load = [at](const Point<2> &x)
      { return x.distance(Point<2>(at, 9.)) < 2 ? -3. : 0.; };
      Scene<2> scene = strip(n_cells);
      scene.body_force[1] = expression<2>(load);
      Mesh mesh(scene);
      const double exact = -12 * dealii::numbers::PI;
      EXPECT_NEAR(mesh.rules.sum().force[1], exact, 0.02 * std::abs(exact)) << at;
      const auto unresolved = mesh.rules.unresolved(mesh.mesh);
      ASSERT_FALSE(unresolved.empty());
      EXPECT_EQ(unresolved[0].name, "Body force");
      EXPECT_LT(unresolved[0].where.distance(Point<2>(at, 9.)), 4.);
      const double before = std::abs(inside(scene, mesh, load) - exact);
      mesh.bisect({{at, 9.}, {at, 9. + 1e-3}}, 3); // cells are cut anew
      EXPECT_LT(std::abs(inside(scene, mesh, load) - exact), std::max(0.3 * before, 1e-2)) << at;
    }
}

/** A strip that the whole coarse cell shows must not be lost on its parts. */
TEST(LoadRules, LoseNoStripOfBodyForceOnRefinedCells)
{
  const double width = 0.00526;
  for (double at = 0.05; at < 0.95; at += 0.0317)
  {
    const Function load = [=](const Point<2> &x)
    { return std::max(0., 1 - std::abs(x[0] - at) / width); };
    Scene<2> scene = body({1., 1.}, {{1, 1}});
    scene.body_force[0] = expression<2>(load);
    Mesh mesh(scene);
    if (mesh.rules.sum().force[0] == 0.)
      continue; // narrower than a sixtieth: it may lie between all points
    for (unsigned int level = 1; level <= 2; ++level)
    {
      mesh.mesh.refine_global(1);
      EXPECT_NEAR(inside(scene, mesh, load), width, 0.05 * width) << at << " level " << level;
    }
  }
}

/** Strips across the body that lie between the points of any grid of samples: lines along it have more of them. */
TEST(LoadRules, FindStripsOfEachDatumBetweenTheGrid)
{
  const double half = 1. / 600;
  for (unsigned int k = 0; k < 40; ++k)
    for (const unsigned int n : {1U, 3U})
    {
      const double at = 0.01 + 0.0243 * k;
      const unsigned int d = k % 2;
      const auto strip = [&](const double value)
      {
        return expression<2>(std::function<double(const Point<2> &)>(
            [=](const Point<2> &x) { return std::abs(x[d] - at) < half ? value : 0.; }));
      };
      Scene<2> scene = body({1., 1.}, {{n, n}});
      scene.body_force[0] = strip(7.);
      scene.initial_strains.resize(1);
      scene.initial_strains[0].components[2] = strip(1e-3);
      scene.boundary(d == 0 ? "bottom" : "left").spring.normal = strip(5.);
      const Mesh mesh(scene);
      const auto sum = [&](const Datum datum, const unsigned int c)
      { return mesh.rules.total_of(datum).sum[c]; };
      EXPECT_NEAR(sum(Datum::load, 0), 14 * half, 1e-12) << at;
      EXPECT_NEAR(sum(Datum::initial_strain, 2), 2e-3 * half * 1000 / 1.3, 1e-12) << at;
      EXPECT_NEAR(sum(Datum::spring, 0), 10 * half, 1e-12) << at;
      EXPECT_TRUE(mesh.rules.unresolved(mesh.mesh).empty()) << at;
    }
}

/** Narrower than the distance of samples, at a place where none sees it, and between all lines that are looked along: a finer mesh does, looks closer, and says so. */
TEST(LoadRules, AreMadeAnewWhereAMeshSeesMore)
{
  const double at = 0.1818335832843089 / 0.77537631618652625, half = 0.0041550;
  Scene<2> scene = body({1.289696343729227, 1.}, {{2, 3}});
  scene.body_force[0] = expression<2>(std::function<double(const Point<2> &)>(
      [=](const Point<2> &x)
      { return std::abs(x[0] - at) < half && std::abs(x[1] - 0.65) < 0.05 ? 10. : 0.; }));
  hold(scene, "bottom");
  scene.adaptivity.method = Method::hup2;
  scene.adaptivity.start_degree = 2;
  scene.adaptivity.maximum_steps = 4;
  scene.adaptivity.tolerance = 0;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        const double force = step.equilibrium.loads.force[0];
        EXPECT_NEAR(force, step.number < 4 ? 0. : 2 * half, 1e-12) << step.number;
        EXPECT_EQ(mentions(texts(step.warnings), "steps before knew nothing"), step.number == 4);
      },
      [](const Progress &) {});
}

/** Strips that lie between all samples, until a point of the fourth mesh meets them: a warning has both sums. */
TEST(MissedData, AreToldWhereAFinerMeshSeesThem)
{
  const std::vector<std::pair<std::string, verification::Overrides>> data = {
      {"stresses of initial strains sum to",
       {{"Boundary top/Traction", "0.001; 0"},
        {"Material/Initial strain",
         "0; if(abs(x - 0.24109851031341528) < 4e-4 && abs(y - 0.5) < 0.03, 1, 0); 0"}}},
      {"friction bounds sum to",
       {{"Boundary left/Traction", "1; 0"},
        given::rough("top", "bilateral", "0.1 + if(abs(x - 1.0121133235568793) < 4e-4, 1000, 0)")}},
      {"stiffnesses of springs sum to",
       {{"Boundary left/Traction", "1; 0"},
        {"Boundary right/Spring", "5 + if(abs(y - 0.5414124727934966) < 3e-4, 1000, 0); 0"}}}};
  for (const auto &[words, entries] : data)
  {
    verification::Overrides all = {given::box("1.289696343729227, 1", "2, 3"),
                                   {"Material/Young's modulus", "1000"},
                                   {"Boundary bottom/Displacement", "0; 0"},
                                   given::steps("hup2", "4", "2"),
                                   {"Adaptivity/Tolerance", "0"}};
    all.insert(all.end(), entries.begin(), entries.end());
    std::string told;
    verification::each_step<2>(verification::scene_of(all),
                               [&](const StepReport<2> &step)
                               {
                                 for (const Warning &warning : step.warnings)
                                   if (warning.text.find("steps before knew nothing") !=
                                       std::string::npos)
                                     told = warning.text;
                               });
    EXPECT_EQ(told.find(words), 0U) << words << ": " << told;
  }
}

// ---------------------------------------------------------------- runs

template <class Take>
void run(const Scene<2> &scene, const Take &take)
{
  AdaptiveSolver<2> solver(scene);
  solver.run([&](const StepReport<2> &step) { take(step); });
}

bool warns(const StepReport<2> &step, const std::string &words)
{
  return std::any_of(step.warnings.begin(), step.warnings.end(),
                     [&](const Warning &warning) { return warning.text.find(words) == 0; });
}

TEST(UnresolvedLoads, AreWarnedOfMarkedAndLeaveNoBound)
{
  Scene<2> scene = strip(4);
  // Beside the load on the right the indicator does not see what is left of it.
  scene.boundary("top").traction[1] = expression<2>(
      [](const Point<2> &x) {
        return x[0] > 75 ? -1. : std::abs(x[0] - 40) < 3 ? 1e-4 * std::sin(1e5 * x[0] * x[0]) : 0.;
      });
  scene.adaptivity.indicator = Indicator::residual;
  scene.adaptivity.maximum_steps = 3;
  double smallest = 100;
  run(scene,
      [&](const StepReport<2> &step)
      {
        EXPECT_FALSE(step.bound);
        EXPECT_EQ(step.no_bound.find("traction on top is not resolved near ("), 0U)
            << step.no_bound;
        if (step.stopped_by.empty())
          return;
        EXPECT_EQ(text(step.stopped_by), "Maximum steps");
        EXPECT_TRUE(warns(step, "Traction on top is not resolved near ("));
        for (const auto &cell : step.solution().spaces->mesh->active_cell_iterators())
          if (cell->bounding_box().point_inside({40., 20.}))
            smallest = std::min(smallest, cell->diameter());
      });
  EXPECT_LT(smallest, 10.);
}

/** A square under a load of 2 on a fiftieth of its top. */
Scene<2> narrowly_loaded(const unsigned int steps)
{
  Scene<2> scene = body({1., 1.}, {{1, 1}});
  hold(scene, "bottom");
  scene.boundary("top").traction[1] =
      expression<2>([](const Point<2> &x) { return std::abs(x[0] - 0.371) < 0.01 ? -100. : 0.; });
  scene.adaptivity.maximum_steps = steps;
  return scene;
}

TEST(UnresolvedLoads, DoNotEndARunAsExact)
{
  const Scene<2> scene = narrowly_loaded(2);
  run(scene,
      [&](const StepReport<2> &step)
      {
        EXPECT_NE(text(step.stopped_by), "round-off");
        EXPECT_NEAR(step.solution().spaces->loads->sum().force[1], -2, 1e-12);
        ASSERT_TRUE(step.bound) << step.no_bound;
        EXPECT_TRUE(std::isfinite(step.bound->total));
        EXPECT_GT(step.relative_bound, 0.1);
      });
}

TEST(BoundUnderJumps, IntegratesTheSquareOfALoadByItsRule)
{
  const Scene<2> scene = narrowly_loaded(1);
  run(scene,
      [&](const StepReport<2> &step)
      {
        EquilibrationCache cache;
        const EquilibratedStress stress(step.solution(), {}, {}, cache);
        const auto &edges = stress.patches().edges();
        for (unsigned int e = 0; e < edges.size(); ++e)
          if (edges[e].at_boundary() && edges[e].boundary == 3)
          {
            double square = 0;
            for (const auto &[s, weight] : stress.prescribed().points(e))
              square += weight * stress.prescribed().value(e, s).norm_square();
            EXPECT_NEAR(square, 200, 1e-9);
          }
      });
}

TEST(MissedDisplacements, AreWarnedOfMarkedAndLeaveNoBound)
{
  for (const bool jumps : {false, true})
  {
    Scene<2> scene = body({1., 1.}, {{2, 2}});
    hold(scene, "bottom");
    scene.boundary("top").displacement[1] = expression<2>(
        [jumps](const Point<2> &x)
        {
          const double s = (x[0] - 0.37) / 0.004;
          return jumps ? (std::abs(s) < 1 ? -1e-3 : 0.) : -1e-3 * std::exp(-s * s);
        });
    scene.adaptivity.maximum_steps = 1;
    run(scene,
        [&](const StepReport<2> &step)
        {
          EXPECT_FALSE(step.bound);
          EXPECT_TRUE(warns(step, "Displacement on top lies between the nodes near (0.3"));
          EXPECT_EQ(text(step.stopped_by), "Maximum steps"); // not exact
        });
    scene.adaptivity.maximum_steps = 8;
    run(scene,
        [&](const StepReport<2> &step)
        {
          if (step.number < 8)
            return;
          EXPECT_EQ(warns(step, "Displacement on top"), jumps);
          EXPECT_GT(step.energies.norm, 1e-3);
        });
  }
}

TEST(MissedDisplacements, OfAGapLeaveNoBound)
{
  Scene<2> scene = body({1., 1.}, {{2, 2}});
  scene.boundary("bottom").contact = Contact::unilateral;
  scene.boundary("bottom").gap = expression<2>(
      [](const Point<2> &x) { return -1e-3 * std::exp(-std::pow((x[0] - 0.37) / 0.004, 2)); });
  hold(scene, "top");
  scene.adaptivity.maximum_steps = 1;
  run(scene,
      [&](const StepReport<2> &step)
      {
        EXPECT_FALSE(step.bound);
        EXPECT_EQ(text(step.stopped_by), "Maximum steps");
      });
}

// ---------------------------------------------------------------- the bound

/** The least energy, from both sides, by each step. */
void expect_overlap(const std::vector<std::pair<double, double>> &intervals)
{
  double low = -1e300, high = 1e300;
  for (const auto &[below, above] : intervals)
  {
    low = std::max(low, below);
    high = std::min(high, above);
  }
  EXPECT_LE(low, high + 1e-9 * std::abs(high));
}

std::vector<std::pair<double, double>> intervals_of(const Scene<2> &scene)
{
  std::vector<std::pair<double, double>> result;
  run(scene,
      [&](const StepReport<2> &step)
      {
        ASSERT_TRUE(step.bound) << step.no_bound;
        result.emplace_back(step.energies.energy - step.bound->energy_below,
                            step.energies.energy + step.bound->energy_above);
      });
  return result;
}

/** A load that jumps near the tip of a cantilever: the energies of coarse meshes tell the error, by Galerkin's orthogonality. */
TEST(BoundUnderJumps, IsAboveTheErrorOfACantilever)
{
  Scene<2> scene = body({200., 1.}, {{20, 1}});
  hold(scene, "left");
  scene.boundary("top").traction[1] =
      expression<2>([](const Point<2> &x) { return x[0] > 199.2 ? -1. : 0.; });
  scene.adaptivity.method = Method::hup2;
  scene.adaptivity.start_degree = 2;
  scene.adaptivity.maximum_steps = 2;
  Scene<2> finer = scene;
  finer.geometry.subdivisions = {{100, 1}};
  finer.adaptivity.method = Method::hup4;
  finer.adaptivity.start_degree = 8;
  finer.adaptivity.maximum_steps = 1;
  double least = 0;
  run(finer, [&](const StepReport<2> &step) { least = step.energies.energy; });
  run(scene,
      [&](const StepReport<2> &step)
      {
        ASSERT_TRUE(step.bound) << step.no_bound;
        const double error = std::sqrt(2 * (step.energies.energy - least));
        EXPECT_GE(step.bound->total, error);
      });
}

TEST(BoundUnderJumps, HoldsTheSameEnergyOnTwoMeshes)
{
  std::vector<std::pair<double, double>> intervals;
  for (const unsigned int n : {1, 2, 3, 4})
  {
    Scene<2> scene = body({1., 1.}, {{n, n}});
    hold(scene, "bottom");
    scene.boundary("top").traction[1] =
        expression<2>([](const Point<2> &x) { return x[0] < 0.3 ? -1. : 0.; });
    scene.adaptivity.maximum_steps = 6;
    const auto more = intervals_of(scene);
    intervals.insert(intervals.end(), more.begin(), more.end());
  }
  expect_overlap(intervals);
}

// ---------------------------------------------------------------- data of every kind

using verification::Overrides;

/** What steps guarantee in common: of energies, and of forces by name. */
struct Known
{
  struct Ends
  {
    double low = -1e300, high = 1e300;
  };
  std::map<std::string, Ends> all;
  unsigned int n_bounds = 0;

  void meet(const std::string &name, const double low, const double high)
  {
    Ends &ends = all[name];
    ends.low = std::max(ends.low, low);
    ends.high = std::min(ends.high, high);
  }

  explicit Known(const Overrides &entries)
  {
    run(verification::scene_of(entries),
        [&](const StepReport<2> &step)
        {
          if (!step.stopped_by.empty() && text(step.stopped_by) != "Maximum steps")
          {
            EXPECT_TRUE(std::none_of(step.warnings.begin(), step.warnings.end(),
                                     [](const Warning &warning)
                                     { return warning.kind == WarningKind::load; }))
                << text(step.stopped_by);
          }
          if (!step.bound)
            return;
          ++n_bounds;
          meet("energy", step.energies.energy - step.bound->energy_below,
               step.energies.energy + step.bound->energy_above);
          const auto take = [&](const std::string &name, const Measured &value)
          {
            if (value.interval)
              meet(name, value.interval->centre - value.interval->half_width,
                   value.interval->centre + value.interval->half_width);
          };
          for (const Resultant<2> &row : step.forces)
          {
            take("x on " + row.name, row.force[0]);
            take("y on " + row.name, row.force[1]);
            take("friction on " + row.name, row.friction);
          }
        });
  }
};

/** A datum in a strip of one of n cells, or in a spot: @p at in [0,1] with the half-width 1/2n. */
struct NarrowDatum
{
  std::string name;
  Overrides scene;
  std::string fine; ///< Geometry/Subdivisions with lines at the ends of the strip
};

/** "if(|x - c| < w, value, 0)", c the middle of cell @p k of @p n. */
std::string strip(const std::string &x, const unsigned int k, const unsigned int n,
                  const std::string &value)
{
  return "if(abs(" + x + " - " + verification::in_digits((k + 0.5) / n) + ") < " +
         verification::in_digits(0.5 / n) + ", " + value + ", 0)";
}

/** A square whose left side is held, pulled to the right a little. */
Overrides held_square(const Overrides &more)
{
  return Overrides{{"Boundary left/Displacement", "0; 0"},
                   {"Boundary right/Displacement", "0.001; free"}} +
         more;
}

std::vector<NarrowDatum> narrow_data()
{
  std::vector<NarrowDatum> result;
  std::mt19937 random(55);
  for (unsigned int row = 0; row < 6; ++row)
  {
    const std::string number = "_" + std::to_string(row), x = row % 2 ? "y" : "x";
    const unsigned int n = 12 + random() % 40, k = 1 + random() % (n - 2), few = n / 3;
    const auto cells = [&](const bool along_x)
    { return std::to_string(along_x ? n : few) + ", " + std::to_string(along_x ? few : n); };
    const auto here = [&](const std::string &value) { return strip(x, k, n, value); };
    result.push_back({"heat" + number,
                      held_square({{"Material/Thermal expansion", "0.01"},
                                   {"Temperature/Expression", here("1")}}),
                      cells(row % 2 == 0)});
    result.push_back({"strain" + number,
                      held_square({{"Material/Initial strain",
                                    here("0.01") + "; " + here("-0.003") + "; " + here("0.002")}}),
                      cells(row % 2 == 0)});
    result.push_back({"spring" + number,
                      {{"Boundary left/Displacement", "0; 0.01"},
                       {"Boundary bottom/Spring",
                        strip("x", k, n, "100") + "; " + strip("x", k, n, row % 2 ? "3" : "0")}},
                      cells(true)});
    result.push_back({"pad" + number,
                      {{"Boundary left/Displacement", "0.01; 0"},
                       {"Boundary top/Traction", "0.001; 0"},
                       given::rough("bottom", "bilateral", strip("x", 1 + row, 3 * n, "0.5"))},
                      std::to_string(3 * n) + ", " + std::to_string(n)});
  }
  result.push_back(
      {"spot",
       held_square({{"Material/Thermal expansion", "0.01"},
                    {"Temperature/Expression", strip("x", 12, 20, strip("y", 6, 20, "1"))}}),
       "20, 20"});
  return result;
}

using NarrowData = ::testing::TestWithParam<NarrowDatum>;

/** One cell and 16, whose lines are elsewhere, beside a mesh whose lines are at its ends. */
TEST_P(NarrowData, AreTheSameOnMeshesThatDoNotKnowTheirPlace)
{
  const auto known = [](const std::string &cells, const std::string &steps)
  {
    return Known(GetParam().scene + Overrides{{"Geometry/Subdivisions", cells},
                                              {"Adaptivity/Maximum steps", steps},
                                              {"Adaptivity/Tolerance", "1e-9"}});
  };
  const Known exact = known(GetParam().fine, "2");
  EXPECT_GT(exact.n_bounds, 0U);
  for (const std::string cells : {"1, 1", "4, 4"})
  {
    const Known coarse = known(cells, "6");
    EXPECT_GT(coarse.n_bounds, 0U) << cells;
    for (const auto &[name, ends] : exact.all)
    {
      const auto found = coarse.all.find(name);
      if (found == coarse.all.end())
        continue;
      const double round_off = 1e-9 * std::max(std::abs(ends.low), std::abs(ends.high));
      EXPECT_LE(ends.low, found->second.high + round_off) << name << " with " << cells;
      EXPECT_LE(found->second.low, ends.high + round_off) << name << " with " << cells;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, NarrowData, ::testing::ValuesIn(narrow_data()),
                         [](const auto &row) { return row.param.name; });

/** What friction of a narrow pad may do where a test displacement falls: `int g (1 - s/l) ds`, wherever the pad is. */
TEST(FallAlongFriction, HasTheWorkOfANarrowPad)
{
  for (const double l : {1., 0.25})
    for (unsigned int k = 1; k < 20; ++k)
    {
      const double at = k * l / 20.3, half = l / 250;
      Scene<2> scene = body({1., 1.}, {{4, 4}});
      scene.boundary("bottom").friction.bound =
          expression<2>(std::function<double(const Point<2> &)>(
              [=](const Point<2> &x) { return std::abs(x[0] - at) < half ? 0.5 : 0.; }));
      const Point<2> along(1., 0.);
      const TestMotion::Fall fall{scene.boundary("bottom").id, Point<2>(), 3. * along, along,
                                  TractionKind::friction};
      const double exact = 3 * half * (1 - at / l);
      EXPECT_NEAR(fall.work(scene, l), exact, 1e-9 * exact) << at;
    }
}

// ---------------------------------------------------------------- no end

/** Data that no mesh of the first steps resolves, with a tolerance that the first step meets. */
struct RoughDatum
{
  std::string name;
  Overrides entries;
};

Overrides pushed(const Overrides &more)
{
  return Overrides{{"Boundary left/Displacement", "0; 0"},
                   {"Boundary right/Displacement", "0.01; free"},
                   {"Adaptivity/Tolerance on", "residual"},
                   {"Adaptivity/Tolerance", "100"},
                   {"Adaptivity/Maximum steps", "3"}} +
         more;
}

Overrides rubbing(const std::string &entry, const std::string &value)
{
  return pushed({{"Boundary bottom/Contact", "unilateral"},
                 {"Boundary bottom/" + entry, value},
                 {"Boundary top/Traction", "0; -1"}});
}

const std::vector<RoughDatum> rough_data{
    {"traction", pushed({{"Boundary top/Traction", "0; sin(1e5*x*x)"}})},
    {"body_force",
     pushed({{"Body force/Expression", "if((x - 0.4)^2 + (y - 0.4)^2 < 0.05, 1, 0); 0"}})},
    {"initial_strain", pushed({{"Material/Initial strain", "if(x > 0.2 + 0.7*y, 0.01, 0); 0; 0"}})},
    {"temperature",
     pushed({{"Material/Thermal expansion", "0.01"},
             {"Temperature/Expression", "if((x - 0.4)^2 + (y - 0.4)^2 < 0.05, 1, 0)"}})},
    {"spring", pushed({{"Boundary top/Spring", "2 + sin(1e5*x*x); 0"}})},
    {"displacement",
     pushed({{"Boundary top/Displacement", "free; 0.001*exp(-((x - 0.37)/0.003)^2)"}})},
    {"gap", rubbing("Gap", "-0.01*exp(-((x - 0.371)/0.003)^2)")},
    {"bound", rubbing("Friction bound", "exp(-((x - 0.371)/0.003)^2)")},
    {"bound_jump", rubbing("Friction bound", "if(x > 0.371, 0.3, 0)")},
    {"coefficient", rubbing("Friction coefficient", "0.3 + 0.2*exp(-((x - 0.371)/0.003)^2)")},
    {"coefficient_jump", rubbing("Friction coefficient", "if(x > 0.371, 0.3, 0.1)")}};

using NoEnd = ::testing::TestWithParam<RoughDatum>;

TEST_P(NoEnd, WhereDataAreNotResolved)
{
  run(verification::scene_of(GetParam().entries),
      [](const StepReport<2> &step)
      {
        EXPECT_TRUE(step.number == 3 || step.stopped_by.empty()) << text(step.stopped_by);
        if (step.number == 3)
        {
          EXPECT_EQ(text(step.stopped_by), "Maximum steps");
        }
      });
}

INSTANTIATE_TEST_SUITE_P(Data, NoEnd, ::testing::ValuesIn(rough_data),
                         [](const auto &row) { return row.param.name; });

/** And where they are resolved the tolerance ends the run. */
TEST(AnEnd, IsWhereDataAreResolved)
{
  for (const Overrides &smooth :
       {pushed({{"Boundary top/Traction", "0; x*x"}}), rubbing("Gap", "0.01*x"),
        pushed({{"Material/Thermal expansion", "0.01"},
                {"Temperature/Expression", "if(x > 0.37, 1, 0)"}}),
        rubbing("Friction coefficient", "0.1 + 0.2*x")})
    run(verification::scene_of(smooth),
        [](const StepReport<2> &step) { EXPECT_EQ(text(step.stopped_by), "Tolerance"); });
}
} // namespace
