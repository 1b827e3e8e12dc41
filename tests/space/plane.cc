// SPDX-License-Identifier: LGPL-2.1-or-later
// What the plane knows: there both paths solve the same discrete problem, and so does a slab in space.
#include "runs.h"

#include <hpvi/driver/adaptive_solver.h>

#include <algorithm>
#include <limits>

namespace
{
using namespace space;

std::vector<Step> reduced_steps(const Scene<2> &scene)
{
  std::vector<Step> steps;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        steps.push_back({step.solution().displacement_space.degrees().size(),
                         step.solution().displacement_space.n_free_dofs(), 0, 0,
                         step.energies.lagrangian, step.energies.energy, step.estimate.total(),
                         step.energies.norm});
      });
  return steps;
}

Scene<2> example(const std::string &name, const Overrides &overrides)
{
  Scene<2> scene = read_scene<2>("prm/" + name + ".prm", overrides);
  scene.solver.primal_tolerance = 1e-11;
  return scene;
}

void expect_equal(const std::vector<Step> &primal, const std::vector<Step> &reduced)
{
  ASSERT_EQ(primal.size(), reduced.size());
  for (unsigned int k = 0; k < primal.size(); ++k)
  {
    EXPECT_EQ(primal[k].n_cells, reduced[k].n_cells);
    EXPECT_EQ(primal[k].n_free, reduced[k].n_free);
    EXPECT_NEAR(primal[k].lagrangian, reduced[k].lagrangian,
                1e-9 * std::abs(reduced[k].lagrangian));
    EXPECT_NEAR(primal[k].estimate, reduced[k].estimate, 1e-7 * reduced[k].estimate);
    EXPECT_NEAR(primal[k].norm, reduced[k].norm, 1e-9 * reduced[k].norm);
  }
}

TEST(Plane, BothPathsAgree)
{
  for (const char *const method : {"hap2", "hap3", "hup4"})
  {
    const Scene<2> scene = example("han-6-12", {given::steps(method, "4")});
    expect_equal(steps_of<2>(scene), reduced_steps(scene));
  }
}

TEST(Plane, BothPathsAgreeWhereTheBoundVaries)
{
  const Scene<2> scene =
      example("han-6-12", {given::steps("hap3", "3"),
                           {"Boundary bottom/Friction bound", "1 + x^2"},
                           {"Boundary top/Displacement", "free; -0.01*x*(4 - x)"}});
  expect_equal(steps_of<2>(scene), reduced_steps(scene));
}

/** h_K is the longest edge. */
TEST(Plane, BothPathsAgreeOnRectangles)
{
  const Scene<2> scene =
      example("han-6-12", {given::steps("hap2", "2"), {"Geometry/Subdivisions", "2, 6"}});
  expect_equal(steps_of<2>(scene), reduced_steps(scene));
}

/** Where the bound vanishes contact slips, in counts as in states. */
TEST(Plane, DiscsWithoutFrictionSlip)
{
  const Scene<2> scene =
      example("han-6-12",
              {given::steps("hup3", "1"), {"Boundary bottom/Friction bound", "if(x < 2, 0, 45)"}});
  steps_of<2>(scene,
              [](const StepReport<2> &step)
              {
                const auto slips = [](const ContactPoint<2> &point)
                { return point.mode() == ContactMode::slip; };
                const auto &points = step.contact.at(0).points;
                EXPECT_EQ(step.primal->newton.n_slipping,
                          std::count_if(points.begin(), points.end(), slips));
                EXPECT_GE(step.primal->newton.n_slipping, 4u);
                EXPECT_LT(step.primal->newton.n_slipping, points.size());
              });
}

/** Plane strain: u_z = 0 on both sides of a slab of one layer, whose solution does not depend on z. */
TEST(Plane, SlabIsPlaneStrain)
{
  for (const char *const method : {"hup2", "hup3"})
  {
    const Scene<2> plane =
        example("han-6-12", {given::steps(method, "2"), {"Material/Plane", "strain"}});
    const Scene<3> scene = slab({given::steps(method, "2"),
                                 given::box("4, 4, 0.75", "4, 4, 1"),
                                 {"Boundary left/Traction", "1.5*(5 - y); -0.75; 0"},
                                 {"Boundary front/Displacement", "free; free; 0"},
                                 {"Boundary back/Displacement", "free; free; 0"}});
    const auto thick = steps_of<3>(scene), flat = reduced_steps(plane);
    for (unsigned int k = 0; k < flat.size(); ++k)
      EXPECT_NEAR(thick[k].lagrangian / 0.75, flat[k].lagrangian,
                  1e-9 * std::abs(flat[k].lagrangian));
  }
}

/** Layers a thousand times as stiff as each other: residuals in space weigh as those of plane strain do, which are charted. */
TEST(Plane, SlabOfLayersHasTheIndicatorOfPlaneStrain)
{
  const Overrides layers{{"Material stiff/Where", "y - 2"},
                         {"Material stiff/Young's modulus", "15000"},
                         given::steps("hup2", "2")};
  Overrides flat{{"Material/Plane", "strain"}},
      thick{given::box("4, 4, 0.75", "4, 4, 1"),
            {"Boundary left/Traction", "1.5*(5 - y); -0.75; 0"},
            {"Boundary front/Displacement", "free; free; 0"},
            {"Boundary back/Displacement", "free; free; 0"}};
  flat.insert(flat.end(), layers.begin(), layers.end());
  thick.insert(thick.end(), layers.begin(), layers.end());
  const auto in_space = steps_of<3>(slab(thick)),
             in_plane = reduced_steps(example("han-6-12", flat));
  // cells of the first mesh are as long in z as in x and y or shorter: sizes are those of the plane
  for (unsigned int k = 0; k < in_plane.size(); ++k)
    EXPECT_NEAR(in_space[k].estimate / std::sqrt(0.75), in_plane[k].estimate,
                1e-6 * in_plane[k].estimate);
}

/**
 * Example 5.2 as a slab of plane strain, cubes refined in all directions: no conforming u_N is below the limit per
 * thickness, which prm/han-6-12.prm with Plane = strain reaches to 1e-7.
 */
TEST(Plane, AdaptiveSlabTendsToPlaneStrain)
{
  const double limit = -4.879036, thickness = 2;
  Scene<3> scene = slab({given::steps("hap3", "4"),
                         {"Geometry/Subdivisions", "2, 2, 1"},
                         {"Boundary left/Traction", "1.5*(5 - y); -0.75; 0"},
                         {"Boundary front/Displacement", "free; free; 0"},
                         {"Boundary back/Displacement", "free; free; 0"}});
  scene.solver.primal_tolerance = 1e-8;
  double previous = std::numeric_limits<double>::infinity();
  for (const Step &step : steps_of<3>(scene))
  {
    const double error = step.energy / thickness - limit;
    EXPECT_GT(error, 0);
    EXPECT_LT(error, 0.5 * previous);
    previous = error;
  }
  EXPECT_LT(previous, 6e-4 * std::abs(limit)); // 5.3e-4
}

/** The axes have no names of their own: y and z changed about, contact lies on the front. */
TEST(Plane, TurnedSlabsAgree)
{
  const Overrides steps{{"Adaptivity/Maximum steps", "3"}};
  Overrides turned{given::box("4, 2, 4", "4, 2, 4"),
                   {"Boundary left/Traction", "1.5*(5 - z); 0.5; -0.75"},
                   {"Boundary bottom/Contact", "none"},
                   {"Boundary bottom/Friction bound", ""},
                   given::rough("front", "bilateral", "4.5")};
  turned.insert(turned.end(), steps.begin(), steps.end());
  const auto upright = steps_of<3>(slab(steps)), lying = steps_of<3>(slab(turned));
  for (unsigned int k = 0; k < upright.size(); ++k)
  {
    EXPECT_EQ(upright[k].n_free, lying[k].n_free);
    EXPECT_EQ(upright[k].n_slipping, lying[k].n_slipping);
    EXPECT_NEAR(upright[k].lagrangian, lying[k].lagrangian, 1e-10 * std::abs(lying[k].lagrangian));
  }
}

/** A foundation that carries a millionth of what another does is in contact. */
TEST(Plane, ASmallPressureClosesContact)
{
  Scene<2> scene;
  scene.solver.primal_tolerance = 1e-12;
  scene.solver.normal_contact = NormalContact::multiplier;
  scene.adaptivity.method = Method::hup2;
  scene.adaptivity.start_degree = 2;
  scene.adaptivity.maximum_steps = 1;
  scene.materials[0].poisson = 0;
  for (const char *const side : {"left", "bottom"})
    scene.boundary(side).contact = Contact::unilateral;
  scene.boundary("right").displacement[0] = expression<2>(-1e-6);
  scene.boundary("top").displacement[1] = expression<2>(-1.);
  unsigned int n_points = 0;
  steps_of<2>(scene,
              [&](const StepReport<2> &step)
              {
                for (const ContactState<2> &state : step.contact)
                  for (const ContactPoint<2> &point : state.points)
                  {
                    EXPECT_FALSE(point.is_open);
                    ++n_points;
                  }
              });
  EXPECT_GT(n_points, 1u);
}

/** As scenes of the reduced path are: a force that pulls, from a thousandth of all. */
TEST(Plane, BilateralContactThatPullsIsSaid)
{
  for (const auto &[load, pulls] : {std::make_pair("0; 10", true), {"0; -0.001", false}})
  {
    std::vector<std::string> warnings;
    steps_of<2>(example("han-6-12", {given::steps("hup2", "2"),
                                     {"Boundary left/Traction", load},
                                     {"Boundary top/Traction", pulls ? "" : "0; -50"}}),
                [&](const StepReport<2> &step) { warnings = texts(step.warnings); });
    EXPECT_EQ(mentions(warnings, "bilateral contact pulls"), pulls) << load;
  }
}

/** A thirtieth of the time of all steps is over before the last one. */
TEST(Plane, MaximumSecondsAreSeconds)
{
  Scene<2> scene = example("han-6-12", {given::steps("hup3", "5")});
  double seconds = 0;
  const std::size_t n_steps =
      steps_of<2>(scene, [&](const StepReport<2> &step) { seconds = step.seconds; }).size();
  EXPECT_EQ(n_steps, 5u);
  scene.adaptivity.maximum_seconds = seconds / 30;
  EXPECT_LT(steps_of<2>(scene).size(), n_steps);
}
} // namespace
