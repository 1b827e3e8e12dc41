// SPDX-License-Identifier: LGPL-2.1-or-later
// What results tell of single places, against closed forms; and the rules behind it.
#include "discretisation.h"

#include <hpvi/driver/column_width.h>
#include <hpvi/driver/limits.h>
#include <hpvi/driver/thickness.h>
#include <hpvi/output/results_report.h>
#include <hpvi/output/tables.h>
#include <hpvi/plane/disc_rule.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/results/probe_rule.h>
#include <hpvi/results/values_at.h>

#include <deal.II/base/quadrature_lib.h>

namespace
{
using namespace verification;

constexpr double pi = numbers::PI;

/** A disc and what its rule makes of 1, x, x^2, x y, y^4 on all cells of a mesh. */
void expect_exact(const Triangulation<2> &mesh, const Point<2> &c, const double R,
                  const double tolerance)
{
  std::array<double, 5> sums{};
  for (const auto &cell : mesh.active_cell_iterators())
  {
    const CellMap<2> map = map_of<2>(cell);
    const DiscRule rule = disc_rule(map, c, R, 8);
    for (unsigned int q = 0; q < rule.points.size(); ++q)
    {
      EXPECT_TRUE(GeometryInfo<2>::is_inside_unit_cell(rule.points[q], 1e-12));
      const Point<2> x = map.point(rule.points[q]);
      const std::array<double, 5> f{{1, x[0], x[0] * x[0], x[0] * x[1], std::pow(x[1], 4)}};
      for (unsigned int k = 0; k < 5; ++k)
        sums[k] += rule.areas[q] * f[k];
    }
  }
  const double a = pi * R * R, b = c[1];
  const std::array<double, 5> wanted{
      {a, a * c[0], a * (c[0] * c[0] + R * R / 4), a * c[0] * c[1],
       a * (std::pow(b, 4) + 6 * b * b * R * R / 4 + std::pow(R, 4) / 8)}};
  for (unsigned int k = 0; k < 5; ++k)
    EXPECT_NEAR(sums[k], wanted[k], tolerance * a * (1 + std::pow(c.norm() + R, 4)))
        << c << ", R = " << R << ", k = " << k;
}

Triangulation<2> &mesh_of(const Overrides &entries, Triangulation<2> &mesh)
{
  make_mesh(scene_of(entries), mesh);
  return mesh;
}

const Overrides held{{"Boundary left/Displacement", "0; 0"}};

/** Circles through vertices, along edges that they touch, around cells and inside of one. */
TEST(Discs, AreCutByCellsExactly)
{
  Triangulation<2> grid;
  mesh_of(with(held, {given::box("4, 4", "4, 4")}), grid);
  for (const auto &[c, R] : std::vector<std::pair<Point<2>, double>>{{{2, 2}, 1},
                                                                     {{2, 2}, std::sqrt(2.)},
                                                                     {{1.5, 1.5}, 0.5},
                                                                     {{1.5, 1.5}, std::sqrt(0.5)},
                                                                     {{2, 1.5}, 0.5},
                                                                     {{2.3, 1.7}, 1e-6},
                                                                     {{2.3, 1.7}, 1.7},
                                                                     {{2, 2}, 2},
                                                                     {{1.2, 2.9}, 0.3},
                                                                     {{2, 1.5}, 1e-3},
                                                                     {{2, 2}, 1.0000000001}})
    expect_exact(grid, c, R, R < 1e-5 ? 1e-9 : 1e-13); // round-off of c beside R
}

TEST(Discs, AreCutBySkewAndCurvedCells)
{
  Triangulation<2> skew, distorted, ring;
  mesh_of(with(held, {given::quadrilateral("Geometry", "0, 0; 4, 1; 5, 5; 1, 4", "3, 4")}), skew);
  mesh_of(with(held, {given::quadrilateral("Geometry", "0, 0; 4, 1; 5, 6; -1, 4", "3, 4")}),
          distorted);
  expect_exact(skew, {2.5, 2.5}, 1.3, 1e-13);
  expect_exact(distorted, {2.2, 2.9}, 1.4, 1e-12);
  mesh_of(
      {given::ring("Geometry", "1, 3", "0, 180", "2, 4"), {"Boundary start/Displacement", "0; 0"}},
      ring);
  set_edge_degrees(ring, std::vector<unsigned int>(ring.n_active_cells(), 8));
  expect_exact(ring, {0.1, 2}, 0.9, 1e-10);
  expect_exact(ring, {1.3, 1.2}, 0.5, 1e-10);
}

/** By rings of points, of a smooth field. */
Tensor<1, 2> mean_over_disc(const ExactSolution<2> &exact, const Point<2> &c, const double R)
{
  const QGauss<1> radial(30);
  const unsigned int n = 80;
  Tensor<1, 2> sum;
  for (unsigned int q = 0; q < radial.size(); ++q)
    for (unsigned int k = 0; k < n; ++k)
    {
      const double r = R * radial.point(q)[0], angle = 2 * pi * k / n;
      sum += radial.weight(q) * 2 * radial.point(q)[0] / n *
             exact.displacement(c + r * Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
    }
  return sum;
}

/** The last step of a run with probes. */
struct LastStep
{
  explicit LastStep(const Scene<2> &scene)
  {
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          probes = step.probes;
          lines = step.probe_lines;
          forces = step.forces;
          row = row_of(step);
          words = step.stopped_by.empty() ? "" : results_in_words(step);
          largest = step.largest_displacement;
          error = step.errors.energy;
        });
  }

  static Record row_of(const StepReport<2> &step)
  {
    Tables<2> tables;
    tables.add(step);
    return tables.convergence.last;
  }

  std::vector<ProbeValue<2>> probes;
  std::vector<ProbeLine<2>> lines;
  std::vector<Resultant<2>> forces;
  Record row;
  std::string words;
  PlacedValue<2> largest;
  double error = 0;
};

FullStress stress_of(const Scene<2> &scene, const Point<2> &x)
{
  const SymmetricTensor<2, 2> s =
      HookesLaw<2>(scene.materials[0]).stress(scene.exact_solution->gradient(x));
  FullStress result;
  for (unsigned int i = 0; i < 2; ++i)
    for (unsigned int j = i; j < 2; ++j)
      result[i][j] = s[i][j];
  result[2][2] = scene.materials[0].transverse_stress(s);
  return result;
}

/** Discs hold vertices and cut cells of the graded mesh; the transition is on the boundary. */
void expect_probes(const std::string &name, const unsigned int steps, const std::string &point,
                   const std::string &disc, const double R, const double tolerance)
{
  const Scene<2> scene = shipped_scene(name, {{"Adaptivity/Maximum steps", std::to_string(steps)},
                                              {"Probe spot/At", point},
                                              {"Probe core/At", disc},
                                              {"Probe core/Size", in_digits(R)},
                                              {"Probe cut/From", point},
                                              {"Probe cut/To", disc},
                                              {"Probe cut/Points", "7"}});
  const ExactSolution<2> &exact = *scene.exact_solution;
  const LastStep last(scene);
  ASSERT_EQ(last.probes.size(), 2U);
  const Probe<2> &spot = scene.probes[0], &core = scene.probes[1];
  const Tensor<1, 2> u = exact.displacement(spot.at), mean = mean_over_disc(exact, core.at, R);
  for (unsigned int d = 0; d < 2; ++d)
  {
    EXPECT_NEAR(last.probes[0].displacement[d].value, u[d], tolerance * u.norm());
    EXPECT_NEAR(last.probes[1].displacement[d].value, mean[d], tolerance * mean.norm());
  }
  const auto expect_stress = [&](const FullStress &found, const Point<2> &x)
  {
    const FullStress wanted = stress_of(scene, x);
    EXPECT_LT((found - wanted).norm(), 300 * tolerance * wanted.norm()) << name << " at " << x;
  };
  expect_stress(last.probes[0].stress, spot.at);
  ASSERT_EQ(last.lines.size(), 1U);
  ASSERT_EQ(last.lines[0].points.size(), 7U);
  for (const LinePoint<2> &x : last.lines[0].points)
  {
    const Tensor<1, 2> here = exact.displacement(x.x);
    EXPECT_LT((x.displacement - here).norm(), tolerance * u.norm()) << name << " at " << x.x;
    expect_stress(x.stress, x.x);
  }
  EXPECT_EQ(last.lines[0].points.back().x, core.at);
}

TEST(Probes, HoldStickSlip)
{
  expect_probes("stick-slip", 16, "0.3, 0.6", "-0.2, 0.5", 0.4, 1e-8);
}

TEST(Probes, HoldHertz)
{
  expect_probes("hertz", 16, "0.5, 0.8", "0.3, 0.9", 0.6, 1e-8);
}

/** Where four cells meet the stress is the mean of four; the displacement is one. */
TEST(Probes, AreMeansWhereCellsMeet)
{
  const Scene<2> scene = shipped_scene(
      "stick-slip", {{"Adaptivity/Maximum steps", "1"}, {"Probe corner/At", "0.5, 0.5"}});
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        FullStress sum;
        unsigned int n = 0;
        for (const auto &cell : step.field.dof_handler.active_cell_iterators())
          if (const auto reference = reference_of<2>(cell, scene.probes[0].at))
          {
            const PointValue<2> value = step.field.values(cell, {*reference}).front();
            for (unsigned int i = 0; i < 2; ++i)
              for (unsigned int j = i; j < 2; ++j)
                sum[i][j] += value.stress[i][j] / 4;
            ++n;
            for (unsigned int d = 0; d < 2; ++d)
              EXPECT_NEAR(step.probes[0].displacement[d].value, value.displacement[d], 1e-15);
          }
        EXPECT_EQ(n, 4U);
        EXPECT_LT((step.probes[0].stress - sum).norm(), 1e-14 * sum.norm());
      });
}

/** Stresses jump where a temperature does: the part of a disc, or of a side, that is beyond a line inside cells is exact. */
TEST(Probes, AreCutWhereTemperaturesJump)
{
  std::mt19937 random(7);
  const auto in = [&](const double low, const double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  for (unsigned int row = 0; row < 12; ++row)
  {
    const unsigned int d = row % 2;
    const double at = in(0.25, 0.75), R = in(0.1, 0.2), level = at + in(-0.9, 0.9) * R;
    const std::string axis = d == 0 ? "x" : "y", place = in_digits(at),
                      jump = "if(" + axis + " > " + in_digits(level) + ", 30, 10)";
    const Overrides datum =
        row % 3 == 0
            ? Overrides{{"Material/Initial strain", "0; 1e-5*" + jump + "; 0"}}
            : Overrides{{"Material/Thermal expansion", "1e-5"}, {"Temperature/Expression", jump}};
    const Scene<2> scene =
        scene_of(with(with(held, datum), {given::box("1, 1", row % 4 < 2 ? "2, 3" : "3, 1"),
                                          {"Adaptivity/Maximum steps", "1"},
                                          {"Probe disc/At", place + ", " + place},
                                          {"Probe disc/Size", in_digits(R)},
                                          {"Probe side/On", d == 0 ? "top" : "right"}}));
    const double c = (level - at) / R; // a segment of the circle is beyond
    const std::array<double, 2> wanted{{(std::acos(c) - c * std::sqrt(1 - c * c)) / pi, 1 - level}};
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          for (unsigned int k = 0; k < 2; ++k)
          {
            double beyond = 0;
            for (const WeightedPoints<2> &part :
                 probe_rule(scene.probes[k], scene, step.field.dof_handler, step.field.tables))
              for (unsigned int q = 0; q < part.points.size(); ++q)
                beyond +=
                    map_of<2>(part.cell).point(part.points[q])[d] > level ? part.weights[q] : 0.;
            EXPECT_NEAR(beyond, wanted[k], 1e-12) << "row " << row << ", probe " << k;
          }
        });
  }
}

/** A side is itself and its parts, a part is one alone; weights are lengths. */
TEST(Probes, GoAlongSidesAndTheirParts)
{
  const Scene<2> scene = scene_of({given::box("2, 1", "4, 2"),
                                   {"Boundary bottom/Displacement", "0; 0"},
                                   {"Boundary seat/On", "top"},
                                   {"Boundary seat/Where", "0.5 - x"},
                                   {"Boundary seat/Displacement", "0; -0.1"},
                                   {"Boundary top/Displacement", "0; -0.1 - 0.2*(x - 0.5)"},
                                   given::steps("hup2", "1"),
                                   {"Probe all/On", "top"},
                                   {"Probe part/On", "seat"}});
  EXPECT_EQ(scene.probes[0].on.size(), 2U);
  EXPECT_EQ(scene.probes[1].on.size(), 1U);
  const LastStep last(scene);
  EXPECT_NEAR(last.probes[0].displacement[1].value, -0.1 - 0.2 * 1.5 * 1.5 / 2 / 2, 1e-14);
  EXPECT_NEAR(last.probes[1].displacement[1].value, -0.1, 1e-14);
}

/** The list of names that probes may not have, against the table; a history has two more. */
TEST(Probes, AreNotCalledLikeColumns)
{
  Scene<2> scene = shipped_scene("stick-slip", {{"Adaptivity/Maximum steps", "1"}});
  Record row = LastStep(scene).row;
  std::vector<std::string> names{"residual", "bound", "load_step", "t"};
  for (const auto &[name, value] : row)
    names.push_back(name);
  EXPECT_GT(names.size(), 80U);
  for (const std::string &name : names)
  {
    scene.probes.assign(1, Probe<2>());
    scene.probes[0].name = name;
    EXPECT_THROW(check(scene), InputError) << name;
  }
  scene.probes[0].name = "tip";
  EXPECT_NO_THROW(check(scene));
  scene.probes.push_back(scene.probes[0]);
  scene.probes[1].name = "tip_mises";
  EXPECT_THROW(check(scene), InputError);
}

/** Columns of a probe stand at the end, in the order of its own list. */
TEST(Probes, HaveTheLastColumns)
{
  const Scene<2> scene =
      shipped_scene("stick-slip", {{"Adaptivity/Maximum steps", "1"}, {"Probe tip/At", "1, 1"}});
  const Record row = LastStep(scene).row;
  const std::vector<std::string> columns = columns_of(scene.probes[0]);
  ASSERT_EQ(columns.size(), 8U);
  for (unsigned int k = 0; k < columns.size(); ++k)
    EXPECT_EQ(row[row.size() - columns.size() + k].first, columns[k]);
  EXPECT_EQ(row[row.size() - columns.size() - 1].first, "friction_resultant_bound");
}

/** Intervals as somebody would find them. */
TEST(Intervals, ReachTablesAndLimits)
{
  const Scene<2> scene = scene_of({given::rough("bottom", "bilateral", "0.1"),
                                   {"Boundary left/Displacement", "0; free"},
                                   {"Boundary top/Traction", "0.2; 0"},
                                   {"Material/Thickness", "2"},
                                   {"Adaptivity/Maximum steps", "1"},
                                   {"Adaptivity/Tolerance on", "core"},
                                   {"Adaptivity/Tolerance", "0.1"},
                                   {"Probe core/At", "0.5, 0.5"},
                                   {"Probe core/Size", "0.25"}});
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &report)
      {
        StepReport<2> step = report;
        EXPECT_GT(relative_half_width(step), 0.);
        for (Resultant<2> &row : step.forces)
          if (row.kind == ForceKind::contact)
            row.friction.interval = Interval{row.friction.value + 0.003, 0.01};
        for (unsigned int d = 0; d < 2; ++d)
        {
          Measured &u = step.probes[0].displacement[d];
          u.interval = Interval{u.value, d == 0 ? 1e-3 : 2e-3};
        }
        const auto &u = step.probes[0].displacement;
        EXPECT_NEAR(relative_half_width(step), 2e-3 / std::hypot(u[0].value, u[1].value), 1e-15);
        const Record row = LastStep::row_of(step);
        const auto value = [&](const std::string &name)
        { return number_of(row, name).value_or(-1); };
        EXPECT_NEAR(value("friction_resultant_bound"), 0.013, 1e-14);
        EXPECT_EQ(value("core_ux_bound"), 1e-3);
        EXPECT_EQ(value("core_uy_bound"), 2e-3);
        EXPECT_NE(results_in_words(step).find("friction on bottom"), std::string::npos);
        const double before = measured_in(step, "friction_resultant")->interval->centre;
        take_thickness(step);
        EXPECT_EQ(measured_in(step, "friction_resultant")->interval->half_width, 0.02);
        EXPECT_EQ(measured_in(step, "friction_resultant")->interval->centre, 2 * before);
        EXPECT_EQ(step.probes[0].displacement[1].interval->half_width, 2e-3);
      });
  PastStep<2> step{};
  step.relative_estimate = step.relative_bound = 1e-3; // not asked for
  step.estimate = 1;
  for (const auto &[width, limit] :
       std::vector<std::pair<double, Stop>>{{0.09, Stop::tolerance},
                                            {0.11, Stop::maximum_steps},
                                            {std::nan(""), Stop::maximum_steps}})
  {
    step.relative_half_width = width;
    EXPECT_EQ(reached_limit<2>(scene, {step}, {10, 1., 1., []() { return 0.; }}), limit);
  }
}

/** What is printed holds what it rounds. */
TEST(Intervals, AreRoundedOutwards)
{
  EXPECT_EQ(interval_in_words({-8.787164, 0.000209}), "-8.78716 +- 0.00022");
  EXPECT_EQ(interval_in_words({-8.78716, 0.00021}), "-8.78716 +- 0.00021");
  EXPECT_EQ(interval_in_words({1234.5, 20.}), "1235 +- 21");
  EXPECT_EQ(interval_in_words({0.0004, 0.01}), "0 +- 0.011");
  EXPECT_EQ(interval_in_words({-1e-12, 13.}), "0 +- 14");
  EXPECT_EQ(interval_in_words({3., 0.}), "3 +- 0");
}

/** Inside, where cells meet, on curves and beside the body: one by one and all at once. */
TEST(ValuesAt, AreThoseOfEachPoint)
{
  const Scene<2> scene = shipped_scene("press-ring", {{"Adaptivity/Maximum steps", "2"}});
  AdaptiveSolver<2>(scene).run(
      [](const StepReport<2> &step)
      {
        std::vector<Point<2>> points{{100, 0}};
        for (const auto &cell : step.field.dof_handler.active_cell_iterators())
          for (const Point<2> &reference :
               {Point<2>(0.3, 0.6), Point<2>(0, 0.5), Point<2>(0.5, 1), Point<2>(1, 1)})
            points.push_back(map_of<2>(cell).point(reference));
        const auto values = values_at(step.field, points);
        EXPECT_FALSE(values[0]);
        for (std::size_t k = 1; k < points.size(); ++k)
        {
          const auto one = step.field.at(points[k]);
          ASSERT_TRUE(one && values[k]) << points[k];
          EXPECT_EQ(values[k]->displacement, one->displacement) << points[k];
          EXPECT_EQ(values[k]->stress, one->stress) << points[k];
          EXPECT_EQ(values[k]->across, one->across) << points[k];
        }
      });
}

/** Where |u_N| is largest, and von Mises' stress. */
TEST(Extremes, HavePlaces)
{
  const LastStep last(scene_of({{"Geometry/Upper corner", "2, 1"},
                                given::elastic("10", "0"),
                                {"Boundary left/Displacement", "0; 0"},
                                {"Boundary right/Displacement", "0.3; -0.4"},
                                {"Adaptivity/Maximum steps", "1"}}));
  EXPECT_NEAR(last.largest.value, 0.5, 1e-14);
  EXPECT_NEAR(last.largest.where[0], 2., 1e-14);
  EXPECT_NE(last.words.find("largest displacement 0.5 at (2, "), std::string::npos) << last.words;
  EXPECT_NE(last.words.find("largest von Mises' stress "), std::string::npos);
}
} // namespace
