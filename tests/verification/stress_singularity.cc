// SPDX-License-Identifier: LGPL-2.1-or-later
// Where stresses are largest, and which of them grow without bound.
#include "discretisation.h"

#include <hpvi/driver/load_history.h>
#include <hpvi/output/contact_report.h>

namespace
{
using namespace verification;

using Sample = StressSample<2>;
using Steps = std::vector<std::vector<Sample>>;

constexpr types::boundary_id body = numbers::invalid_boundary_id;

/** One peak in each of some steps, of the values given, in edges that are halved. */
Steps halved(const std::vector<double> &values, const types::boundary_id boundary = 2,
             const double distance = 0.)
{
  Steps steps;
  double length = 1;
  for (const double value : values)
  {
    steps.push_back({Sample{boundary, value, Point<2>(3 + distance * length, 0), length}});
    length /= 2;
  }
  return steps;
}

TEST(GrowingPeaks, TakeThreeStepsOfFifteenPercent)
{
  EXPECT_EQ(growing_extrema(halved({1., 1.16, 1.35, 1.57})).size(), 1U);
  EXPECT_TRUE(growing_extrema(halved({1.16, 1.35, 1.57})).empty());
  EXPECT_TRUE(growing_extrema(halved({1.02, 1.16, 1.35, 1.57})).empty());
  EXPECT_TRUE(growing_extrema(halved({1., 1.14, 1.35, 1.57})).empty());
  EXPECT_TRUE(growing_extrema(halved({1., 1.16, 1.35, 1.5})).empty());
  EXPECT_EQ(growing_extrema(halved({9., 9., 1., 1.2, 1.44, 1.73}, body)).at(0).value, 1.73);
}

TEST(GrowingPeaks, StayWhereTheyAre)
{
  const std::vector<double> root = {1., 1.4, 2., 2.8};
  EXPECT_EQ(growing_extrema(halved(root, 2, 0.1)).size(), 1U);
  EXPECT_EQ(growing_extrema(halved(root, 2, 3.9)).size(), 1U); // 1.95 edges
  EXPECT_TRUE(growing_extrema(halved(root, 2, 4.1)).empty());
  Steps elsewhere = halved(root);
  elsewhere[1][0].boundary = 1;
  EXPECT_TRUE(growing_extrema(elsewhere).empty());
}

/** Around a vertex of one mesh the stress has to grow by 15 % from ring to ring, and no less near it than far away. */
TEST(GrowingPeaks, HaveRingsThatGrowInwards)
{
  struct Row
  {
    std::vector<double> rings; ///< the largest stress in each, the innermost first
    bool grows;
  };
  each_step<2>(
      scene_of({{"Geometry/Subdivisions", "2, 2"},
                {"Boundary left/Displacement", "0; 0"},
                {"Boundary right/Traction", "1; 0"},
                {"Adaptivity/Maximum steps", "1"}}),
      [](const StepReport<2> &step)
      {
        const Sample peak{2, 8., Point<2>(0.501, 0), 0.01};
        for (const Row &row : {Row{{8, 4, 2, 1}, true}, Row{{1.76, 1.45, 1.2, 1}, true},
                               Row{{1.51, 1.32, 1.16, 1}, false}, // 14 % at the vertex
                               Row{{1.51, 1.31, 1.14, 1}, false}, // and farthest away
                               Row{{2.8, 2.3, 1.6, 1}, false},    // rounder the nearer it is
                               Row{{8, 4, 0, 1}, false}, Row{{8, 4, 2, 0}, false},
                               Row{{9, 4, 2, 1}, false}}) // of a peak beside it
        {
          std::vector<Sample> samples;
          for (unsigned int k = 0; k < 4; ++k)
          {
            const double radius = 0.0075 * (1U << k);
            samples.push_back({2, row.rings[k], Point<2>(0.5 + radius, 0), 0.01});
            samples.push_back({2, 0.9 * row.rings[k], Point<2>(0.5 - radius, 0), 0.01});
            samples.push_back({1, 99., Point<2>(0.5, radius), 0.01});
          }
          EXPECT_EQ(extrema_of_rings({peak}, samples, step.field).size(), row.grows ? 1U : 0U)
              << row.rings[0] << ' ' << row.rings[2];
        }
      });
}

/** Two corners in turn the larger one: both grow. */
TEST(GrowingPeaks, MayBeTwoAtATime)
{
  Steps steps;
  for (const double k : {0, 1, 2, 3})
  {
    const double a = std::pow(1.4, k), b = a * (int(k) % 2 ? 1.02 : 0.98);
    std::vector<Sample> both = {{2, a, Point<2>(0, 0), std::pow(0.5, k)},
                                {2, b, Point<2>(9, 0), std::pow(0.5, k)}};
    if (b > a)
      std::swap(both[0], both[1]);
    steps.push_back(both);
  }
  EXPECT_EQ(growing_extrema(steps).size(), 2U);
}

/** The largest, and what is out of its reach. */
TEST(StressPeaks, AreApart)
{
  Scene<2> scene;
  scene.geometry.corners = box_corners<2>(Point<2>(), Point<2>(4, 3)); // 0.05 counts as one place
  const std::vector<Sample> samples = {
      {2, 5., Point<2>(0, 0), 1e-3},     {2, 9., Point<2>(1, 0), 1e-3},
      {2, 8., Point<2>(1.049, 0), 1e-3}, {2, 7., Point<2>(1.051, 0), 1e-3},
      {2, 6., Point<2>(2, 0), 1e-3},     {body, 1., Point<2>(1, 0), 1.}};
  std::vector<double> values;
  for (const Sample &peak : stress_extrema(samples, scene))
    values.push_back(peak.value);
  EXPECT_EQ(values, (std::vector<double>{9., 7., 6., 1.}));
}

/** A block under uniform stress, by hand. */
TEST(VonMises, OfABlockIsKnown)
{
  for (const std::string plane : {"stress", "strain"})
  {
    double largest = 0;
    each_step<2>(scene_of({{"Geometry/Subdivisions", "2, 1"},
                           given::elastic("10", "0.3"),
                           {"Material/Plane", plane},
                           {"Boundary left/Displacement", "0; free"},
                           {"Boundary bottom/Displacement", "free; 0"},
                           {"Boundary top/Traction", "0; -2"},
                           {"Adaptivity/Maximum steps", "1"}}),
                 [&](const StepReport<2> &step) { largest = step.extrema.at(0).value; });
    // sigma_yy = -2; under plane strain sigma_zz = -0.6
    const double expected = plane == "stress" ? 2. : std::sqrt(4. + 0.36 - 1.2);
    EXPECT_NEAR(largest, expected, 1e-9);
  }
}

/** In each step: the places where the run would say "unbounded" if it ended there. */
std::vector<std::vector<Sample>> growing(const Scene<2> &scene)
{
  std::vector<std::vector<Sample>> result;
  Steps steps;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        steps.push_back(step.extrema);
        result.push_back(growing_extrema(steps));
      });
  return result;
}

bool holds_pressure(const std::vector<Sample> &extrema)
{
  return std::any_of(extrema.begin(), extrema.end(),
                     [](const Sample &peak) { return peak.boundary != body; });
}

TEST(StressSingularity, IsNeverSaidOfBoundedPressures)
{
  for (const std::string scene : {"hertz", "ssnv128"})
    for (const auto &extrema : growing(shipped_scene(scene, {{"Adaptivity/Maximum steps", "9"}})))
      EXPECT_FALSE(holds_pressure(extrema)) << scene;
  for (const auto &extrema : growing(shipped_scene("hertz", {{"Adaptivity/Maximum steps", "9"}})))
    EXPECT_TRUE(extrema.empty());
}

/** The edge of the punch: the last edges carry little, and what is away from it has converged. */
TEST(StressSingularity, IsSaidOfPunches)
{
  for (const std::string scene : {"punch", "punch-friction"})
    for (const std::string steps : {"9", "12"})
    {
      std::vector<StressSingularity<2>> pressures;
      double force = 0;
      each_step<2>(shipped_scene(scene, {{"Adaptivity/Maximum steps", steps}}),
                   [&](const StepReport<2> &step)
                   {
                     force = -step.contact.at(0).normal_resultant;
                     for (const StressSingularity<2> &stress : step.unbounded)
                       if (stress.peak.boundary != body)
                         pressures.push_back(stress);
                   });
      ASSERT_EQ(pressures.size(), 1U) << scene << " after " << steps;
      const StressSingularity<2> &edge = pressures[0];
      EXPECT_EQ(edge.where, (Point<2>(1, 0)));
      EXPECT_GT(edge.peak.value, 20.);
      EXPECT_GT(edge.force, 0.);
      EXPECT_LT(edge.force, 0.2 * force);
      EXPECT_GT(edge.beyond, 0.04 * std::sqrt(2.) - 1e-12);
      EXPECT_LT(edge.largest, edge.peak.value);
      EXPECT_GT(edge.largest, 0.);
      EXPECT_GE(edge.largest_point.distance(Point<2>(1, 0)), edge.beyond - edge.peak.length);
    }
}

/** A cone of titanium that is pressed into a socket of bone: its corner below is an edge with unbounded pressure. */
const Overrides cone = {given::quadrilateral("Body stem", "0, 0; 5, 0; 8, 60; 0, 60", "2, 10"),
                        {"Body stem/Material", "Ti"},
                        given::quadrilateral("Body bone", "5, 0; 14, 0; 14, 60; 8, 60", "2, 10"),
                        given::elastic("17000", "0.3"),
                        {"Material/Plane", "axisymmetric"},
                        {"Material Ti/Young's modulus", "110000"},
                        {"Boundary stem.top/Pressure", "10*t"},
                        {"Boundary bone.bottom/Displacement", "0; 0"},
                        {"Contact cone/Between", "stem.right, bone.left"},
                        {"Contact cone/Friction coefficient", "0.3"}};

/** A block on a wider one: an edge on a half plane. */
const Overrides block_on_block = {given::block("foot", "-1, 0", "1, 2", "2, 2"),
                                  given::block("ground", "-4, -4", "4, 0", "8, 4"),
                                  {"Boundary foot.top/Displacement", "0; -0.01*t"},
                                  {"Boundary ground.bottom/Displacement", "0; 0"},
                                  {"Contact sole/Between", "foot.bottom, ground.top"}};

/**
 * Places where a run ends with unbounded pressures, and the largest pressure away from them: in each load step of a history with one mesh
 * or with several as in the static run under the load of its end. Loads are proportional, and friction or none makes no other corner.
 */
TEST(StressSingularity, IsSeenInHistoriesAsWithoutThem)
{
  struct Row
  {
    std::string name;
    Overrides entries, last; ///< last: what a static run has in their place
    bool bounded = false;
  };
  const Overrides rolled = {given::box("-2, 0", "2, 2", "8, 2"),
                            {"Boundary top/Displacement", "0; -0.02*t"},
                            {"Boundary bottom/Contact", "unilateral"}};
  for (const Row &row :
       {Row{"cone", cone, {{"Boundary stem.top/Pressure", "10"}}},
        Row{"cone without friction",
            with(cone, {{"Contact cone/Friction coefficient", ""}}),
            {{"Boundary stem.top/Pressure", "10"}}},
        Row{"block", block_on_block, {{"Boundary foot.top/Displacement", "0; -0.01"}}},
        Row{"block, nothing first",
            with(block_on_block, {{"Boundary foot.top/Displacement", "0; -0.02*max(0, t - 0.5)"}}),
            {{"Boundary foot.top/Displacement", "0; -0.01"}}},
        Row{"punch with an edge",
            with(rolled, {{"Boundary bottom/Gap", "if(abs(x) < 1, 0, 1)"}}),
            {{"Boundary top/Displacement", "0; -0.02"}}},
        Row{"roller",
            with(rolled, {{"Boundary bottom/Gap", "x^2/20"}}),
            {{"Boundary top/Displacement", "0; -0.02"}},
            true},
        Row{"block that slips at its corners", // stresses like r^-0.38 there; r^0 without friction
            with(rolled, {{"Boundary bottom/Friction coefficient", "0.4"}}),
            {{"Boundary top/Displacement", "0; -0.02"}}},
        Row{"block on a plane", rolled, {{"Boundary top/Displacement", "0; -0.02"}}, true}})
  {
    using Place = std::pair<Point<2>, double>;
    const auto unbounded = [](const StepReport<2> &step)
    {
      std::vector<Place> places;
      for (const StressSingularity<2> &stress : step.unbounded)
        if (stress.peak.boundary != body)
          places.emplace_back(stress.where, stress.largest);
      std::sort(places.begin(), places.end(),
                [](const Place &a, const Place &b) { return a.first[0] < b.first[0]; });
      return places;
    };
    std::vector<Place> exact;
    const Overrides limits = {{"Adaptivity/Tolerance", "0"}, {"Adaptivity/Maximum steps", "10"}};
    each_step<2>(scene_of(with(with(row.entries, row.last), limits)),
                 [&](const StepReport<2> &step) { exact = unbounded(step); });
    EXPECT_EQ(exact.empty(), row.bounded) << row.name;
    for (const std::string adapt : {"first step", "every step"})
      LoadHistory<2>(scene_of(with(with(row.entries, limits),
                                   {{"Loading/Steps", "3"}, {"Loading/Adapt", adapt}})))
          .run(
              [&](const StepReport<2> &step)
              {
                if (step.load.number < 3 || step.stopped_by.empty())
                  return;
                const std::vector<Place> places = unbounded(step);
                ASSERT_EQ(places.size(), exact.size()) << row.name << ' ' << adapt;
                for (unsigned int k = 0; k < places.size(); ++k)
                {
                  EXPECT_LT(places[k].first.distance(exact[k].first), 1e-2) << row.name;
                  EXPECT_NEAR(places[k].second, exact[k].second, 0.2 * exact[k].second) << row.name;
                }
              });
  }
}

/** von Mises' stress of Example 5.2 at its clamped corner; and as text. */
TEST(StressSingularity, OfVonMisesIsSaidAtAClampedCorner)
{
  std::string words, json;
  bool found = false;
  const Scene<2> scene = shipped_scene("han-6-12", {{"Adaptivity/Maximum steps", "10"}});
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        for (const StressSingularity<2> &stress : step.unbounded)
          found = found ||
                  (stress.peak.boundary == body && stress.force == 0. && stress.where[0] == 4.);
        if (step.stopped_by.empty())
          return;
        words = contact_in_words(step);
        for (const auto &[name, member] : contact_members(step))
          if (name == "von_mises")
            json = member;
      });
  EXPECT_TRUE(found);
  EXPECT_NE(words.find("\nvon Mises' stress is unbounded at (4 "), std::string::npos) << words;
  EXPECT_NE(json.find("\"unbounded\": [\n"), std::string::npos) << json;
}
} // namespace
