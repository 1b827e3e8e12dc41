// SPDX-License-Identifier: LGPL-2.1-or-later
// Hexahedra of second order: faces that are curved, contact along them.
#include "grid.h"

#include <hpvi/base/input_error.h>
#include <hpvi/results/mean_gradients.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/hexahedral_mesh.h>
#include <hpvi/scene/side_normals.h>

#include <algorithm>

namespace
{
using namespace space;

constexpr double pi = numbers::PI;

/** A quarter of a ring of radii 1 and 2 around the z axis, half as high as its inner radius. */
Point<3> ring(const Point<3> &x)
{
  const double r = 1 + x[0], angle = pi / 2 * x[1];
  return {r * std::cos(angle), r * std::sin(angle), 0.5 * x[2]};
}

/** Three radii of curvature: a quadratic of the cells of a single layer, so that the mesh has it exactly. */
Point<3> pillow(const Point<3> &x)
{
  const double below = 0.3 * x[0] * x[0] + 0.2 * x[0] * x[2] - 0.25 * x[2] * x[2];
  return {x[0], below * (1 - x[1]) + x[1] * (1 + 0.1 * x[0] * x[2]), x[2]};
}

Point<3> turned(const Point<3> &x)
{
  const double c = std::cos(0.5), s = std::sin(0.5), d = std::cos(0.3), t = std::sin(0.3);
  const Point<3> y(c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]);
  return {y[0], d * y[1] - t * y[2], t * y[1] + d * y[2]};
}

Point<3> turned_back(const Point<3> &x)
{
  const double c = std::cos(0.5), s = std::sin(0.5), d = std::cos(0.3), t = std::sin(0.3);
  const Point<3> y(x[0], d * x[1] + t * x[2], -t * x[1] + d * x[2]);
  return {c * y[0] + s * y[1], -s * y[0] + c * y[1], y[2]};
}

/** E = 200, nu = 0.3, planes of symmetry at the ends and on both sides of a ring of @p n cells around. */
Scene<3> ring_scene(const unsigned int n, const unsigned int n_nodes, const Overrides &entries)
{
  Overrides all{{"Material/Young's modulus", "200"},  {"Material/Poisson's ratio", "0.3"},
                {"Boundary front/Symmetry", "true"},  {"Boundary back/Symmetry", "true"},
                {"Boundary bottom/Symmetry", "true"}, {"Boundary top/Symmetry", "true"},
                {"Adaptivity/Maximum steps", "1"}};
  for (const auto &entry : entries)
    all.push_back(entry);
  Scene<3> scene = scene_of({{{std::max(1U, n / 2), n, 1}}, ring, true, Grid::everywhere, n_nodes},
                            "curved-ring", all);
  scene.solver.primal_tolerance = 1e-11;
  return scene;
}

Tensor<1, 3> force_on_left(const StepReport<3> &step)
{
  Tensor<1, 3> result;
  for (const Resultant<3> &resultant : step.forces)
    if (resultant.name == "left")
      for (unsigned int c = 0; c < 3; ++c)
        result[c] += resultant.force[c].value;
  return result;
}

/** Of Lame's ring under a pressure 1 inside, in plane strain: u_r at the inner radius. */
const double lame = 1.3 / (200 * 3) * (0.4 + 4);

/** A constant stress, on cells with hanging nodes whose inner faces are curved too, by nodes of 20 and 27. */
TEST(CurvedHexahedra, HaveConstantStress)
{
  const Tensor<2, 3> B({{0.1, -0.02, 0.03}, {0.05, -0.1, 0.04}, {-0.03, 0.06, 0.2}});
  const KnownField<3> exact{[=](const Point<3> &x) { return B * x; },
                            [=](const Point<3> &) { return B; }};
  const Map wave = [](const Point<3> &x)
  {
    return turned({x[0] + 0.1 * x[1] * (1 - x[1]), x[1] + 0.1 * std::sin(pi * x[2]) * x[0],
                   x[2] + 0.08 * std::sin(pi * x[0])});
  };
  for (const unsigned int n_nodes : {20U, 27U})
    for (const unsigned int degree : {2U, 3U})
      for (const LinearMethod linear : {LinearMethod::multigrid, LinearMethod::direct})
      {
        Scene<3> scene =
            scene_of({{{2, 2, 2}}, wave, true, Grid::everywhere, n_nodes}, "curved-patch");
        scene.adaptivity.start_degree = degree;
        scene.adaptivity.maximum_steps = 1;
        scene.solver.linear = linear;
        scene.solver.primal_tolerance = 1e-12;
        scene.geometry.graded_towards = {wave(Point<3>(0, 0, 0))};
        scene.geometry.grading_levels = 2;
        for (BoundaryCondition<3> &boundary : scene.boundaries)
          prescribe(boundary, exact);
        steps_of<3>(scene,
                    [&](const StepReport<3> &step)
                    {
                      EXPECT_TRUE(
                          step.primal->space.dof_handler.get_triangulation().has_hanging_nodes());
                      const Point<3> unit(0.3, 0.6, 0.2);
                      for (const auto &cell : step.field.dof_handler.active_cell_iterators())
                        EXPECT_LT((step.field.values(cell, {unit})[0].displacement -
                                   exact.value(map_of<3>(cell).point(unit)))
                                      .norm(),
                                  1e-10);
                      EXPECT_LT(step.norms.total, 1e-8);
                      for (const MeanGradient<3> &mean : mean_gradients(step.field))
                        EXPECT_LT((mean.value - B).norm(), 1e-10);
                    });
      }
}

/** u = -c x presses with one pressure everywhere, along normals that turn. */
TEST(CurvedHexahedra, PressUniformly)
{
  for (const bool is_turned : {false, true})
    for (const unsigned int degree : {2U, 3U, 4U})
    {
      const Map map = [=](const Point<3> &x) { return is_turned ? turned(pillow(x)) : pillow(x); };
      Scene<3> scene = scene_of({{{2, 1, 2}}, map, true, Grid::everywhere, 27}, "curved-pressure");
      scene.adaptivity.start_degree = degree;
      scene.adaptivity.maximum_steps = 1;
      scene.solver.primal_tolerance = 1e-12;
      scene.geometry.graded_towards = {map(Point<3>())};
      scene.geometry.grading_levels = 1;
      const KnownField<3> exact{[](const Point<3> &x) { return -0.01 * x; }, [](const Point<3> &)
                                { return -0.01 * Tensor<2, 3>(unit_symmetric_tensor<3>()); }};
      BoundaryCondition<3> &bottom = scene.boundary("bottom");
      for (BoundaryCondition<3> &boundary : scene.boundaries)
        if (boundary.id != bottom.id)
          prescribe(boundary, exact);
      const auto normal = [=](const Point<3> &x) // (q_x, -1, q_z) of the bottom y = q
      {
        const Point<3> y = is_turned ? turned_back(x) : x;
        Tensor<1, 3> n({0.6 * y[0] + 0.2 * y[2], -1, 0.2 * y[0] - 0.5 * y[2]});
        n /= n.norm();
        return is_turned ? Tensor<1, 3>(turned(Point<3>(n))) : n;
      };
      bottom.contact = Contact::unilateral;
      bottom.gap = expression<3>(std::function<double(const Point<3> &)>(
          [&](const Point<3> &x) { return normal(x) * exact.value(x); }));
      const double pressure =
          0.01 * scene.materials[0].young / (1 - 2 * scene.materials[0].poisson);
      steps_of<3>(scene,
                  [&](const StepReport<3> &step)
                  {
                    ASSERT_FALSE(step.contact.at(0).points.empty());
                    for (const ContactPoint<3> &point : step.contact.at(0).points)
                      EXPECT_NEAR(point.normal_traction, -pressure, 1e-8 * pressure);
                    EXPECT_LT(step.norms.total, 1e-7);
                  });
    }
}

/** Lame's ring: the work of the pressure converges as its degree says, up to the error h^4 of the arcs. */
TEST(CurvedHexahedra, ConvergeToLame)
{
  const double exact = -0.5 * lame * pi / 4;
  for (const unsigned int n_nodes : {20U, 27U})
    for (const auto &[degree, within] : {std::pair(2U, 8e-5), {3U, 5e-6}})
    {
      std::vector<double> errors;
      for (const unsigned int n : {4U, 8U})
      {
        Scene<3> scene = ring_scene(n, n_nodes, {{"Boundary left/Pressure", "1"}});
        scene.adaptivity.start_degree = degree;
        errors.push_back(std::abs(steps_of<3>(scene).at(0).energy / exact - 1));
      }
      EXPECT_LT(errors[1], within) << degree;
      EXPECT_GT(errors[0] / errors[1], 12) << degree;
    }
}

/** int n ds is that of the projections; one arc has chords of one direction, and a part makes sides anew. */
TEST(CurvedHexahedra, ArePressedAlongTheirNormalsBesideParts)
{
  const Overrides pressure{{"Boundary left/Pressure", "1"}};
  for (const Overrides &part :
       {Overrides{}, {{"Boundary part/On", "right"}, {"Boundary part/Where", "1"}}})
    steps_of<3>(ring_scene(1, 27, pressure + part),
                [](const StepReport<3> &step)
                {
                  const Tensor<1, 3> force = step.equilibrium.loads.force;
                  EXPECT_LT((force - Tensor<1, 3>({0.5, 0.5, 0})).norm(), 1e-10) << force;
                  for (const Warning &warning : step.warnings)
                    EXPECT_NE(warning.kind, WarningKind::load) << warning.text;
                });
}

/** A quadratic through three points of a quarter of a circle stays within 2 % of it; chords leave it by 29 %. */
TEST(CurvedHexahedra, HaveSidesAlongTheirFaces)
{
  const Scene<3> scene = ring_scene(
      1, 27, {{"Boundary part/On", "right"}, {"Boundary part/Where", "x^2 + y^2 - 3.5"}});
  const std::vector<Side<3>> sides = sides_of(scene);
  for (const BoundaryCondition<3> &boundary : scene.boundaries)
    if (boundary.name == "part" || boundary.name == "left")
    {
      const Side<3> &side = sides[boundary.id];
      ASSERT_EQ(side.pieces.size(), 1U) << boundary.name;
      EXPECT_FALSE(side.is_flat());
      EXPECT_EQ(common_normal(side).norm(), 0);
      const double radius = boundary.name == "left" ? 1 : 2,
                   sign = boundary.name == "left" ? -1 : 1;
      const SideNormals<3> normals(side);
      for (const Point<3> &x : side.sample())
      {
        const Tensor<1, 3> radial = sign * Tensor<1, 3>({x[0], x[1], 0}) / std::hypot(x[0], x[1]);
        EXPECT_NEAR(std::hypot(x[0], x[1]), radius, 0.02 * radius);
        EXPECT_LT((normals(x) - radial).norm(), 0.12);
        EXPECT_EQ(side.normal(x), normals(x));
        ASSERT_EQ(normals_at(side, x).size(), 1U);
        EXPECT_LT((normals_at(side, x)[0] - normals(x)).norm(), 1e-12);
      }
    }
    else if (boundary.name == "right")
      EXPECT_TRUE(sides[boundary.id].pieces.empty());
    else
      EXPECT_TRUE(sides[boundary.id].is_flat()) << boundary.name;
  // Where front and left meet, an arc, both conditions stand.
  for (const Point<3> &x : common_points(sides[4], sides[0]))
    EXPECT_NEAR(std::hypot(x[0], x[1]), 1, 0.02);
  EXPECT_EQ(common_points(sides[4], sides[0]).size(), 17U);
}

/** A shaft that is too thick by what a pressure 1 gives way: pressures and their sum. */
TEST(CurvedHexahedra, FitOntoAShaft)
{
  const Overrides fit{{"Boundary left/Contact", "unilateral"},
                      {"Boundary left/Gap", "-" + std::to_string(lame * 1e6) + "e-6"}};
  for (const auto &[n, degree, within] : {std::tuple(4U, 2U, 1e-3), {8U, 2U, 7e-5}, {8U, 4U, 4e-5}})
    for (const LinearMethod linear : {LinearMethod::multigrid, LinearMethod::amg})
    {
      Scene<3> scene = ring_scene(n, 27, fit);
      scene.adaptivity.start_degree = degree;
      scene.solver.linear = linear;
      steps_of<3>(scene,
                  [&](const StepReport<3> &step)
                  {
                    for (const ContactPoint<3> &point : step.contact.at(0).points)
                      EXPECT_NEAR(point.normal_traction, -1, within);
                    double normal = 0, area = 0;
                    for (const ContactPoint<3> &point : step.contact.at(0).points)
                    {
                      normal -= point.area * point.normal_traction;
                      area += point.area;
                    }
                    EXPECT_NEAR(normal, pi / 4, within);
                    EXPECT_NEAR(area, pi / 4, 3e-5);
                  });
    }
}

/** A ring that is drawn off its shaft: all slips along z, and friction is its bound times the area. */
TEST(CurvedHexahedra, SlipAlongAShaft)
{
  for (const unsigned int degree : {2U, 3U})
  {
    Scene<3> scene = ring_scene(4, 27,
                                {{"Material/Young's modulus", "1e4"},
                                 {"Boundary left/Contact", "tangential"},
                                 {"Boundary left/Friction bound", "0.2"},
                                 {"Boundary front/Symmetry", "false"},
                                 {"Boundary back/Symmetry", "false"},
                                 {"Boundary right/Displacement", "free; free; 1"},
                                 {"Adaptivity/Maximum steps", "2"},
                                 {"Adaptivity/Method", "hap2"}});
    scene.adaptivity.start_degree = degree;
    std::vector<double> energies;
    steps_of<3>(scene,
                [&](const StepReport<3> &step)
                {
                  double area = 0;
                  for (const ContactPoint<3> &point : step.contact.at(0).points)
                  {
                    EXPECT_LT((point.lambda - Tensor<1, 3>({0, 0, 1})).norm(), 1e-4);
                    area += point.area;
                  }
                  EXPECT_NEAR(force_on_left(step)[2], -0.2 * area, 1e-8);
                  EXPECT_NEAR(step.equilibrium.force_imbalance, 0, 1e-8);
                  EXPECT_NEAR(step.equilibrium.moment_imbalance, 0, 1e-8);
                  EXPECT_NEAR(step.energies.slack, 0, 1e-6); // of the work of friction, 0.16
                  energies.push_back(step.energies.energy);
                });
    ASSERT_EQ(energies.size(), 2U);
    EXPECT_LT(energies[1], energies[0]); // of nested spaces
  }
}

/** Springs along normals that turn: a stiff ring that is moved along x by 1 stretches them by n_x. */
TEST(CurvedHexahedra, StandOnSprings)
{
  Scene<3> scene = ring_scene(8, 27,
                              {{"Boundary left/Spring", "3; 1"},
                               {"Boundary front/Symmetry", "false"},
                               {"Boundary back/Symmetry", "false"},
                               {"Boundary bottom/Symmetry", "false"},
                               {"Boundary top/Symmetry", "false"},
                               {"Boundary right/Displacement", "1; 0; 0"},
                               {"Material/Young's modulus", "1e9"}});
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                const Tensor<1, 3> force = force_on_left(step);
                // int k_n n_x^2 + k_t (1 - n_x^2) and int (k_n - k_t) n_x n_y over a quarter of a circle, 0.5 high
                EXPECT_NEAR(force[0], -0.5 * pi / 4 * (3 + 1), 1e-4);
                EXPECT_NEAR(force[1], -0.5 * 2 * 0.5, 1e-4);
              });
}

/** What space offers of plane faces alone. */
TEST(CurvedHexahedra, AreRefusedWhereFacesMustBePlane)
{
  const auto refused = [](const Overrides &entries)
  { return ::failure_of<InputError>([&]() { ring_scene(4, 27, entries); }); };
  for (const auto &[entry, value] :
       {std::pair("Boundary right/Symmetry", "true"), {"Boundary right/Contact", "bilateral"}})
  {
    const std::string line = refused({{entry, value}});
    EXPECT_NE(
        line.find("of a curved cell, and space offers that where it is plane, without friction"),
        std::string::npos)
        << line;
  }
  EXPECT_NE(refused({{"Boundary bottom/Symmetry", "false"},
                     {"Boundary bottom/Contact", "bilateral"},
                     {"Boundary bottom/Friction bound", "1"}})
                .find("where it is plane, without friction"),
            std::string::npos);
  EXPECT_EQ(refused({{"Boundary right/Contact", "unilateral"}}), "");
}

/** Cells of one body keep their nodes where it stands beside others. */
TEST(CurvedHexahedra, AreCurvedBesideOtherBodies)
{
  Grid{{{1, 4, 1}}, ring, false, Grid::everywhere, 27}.write("curved-two.msh");
  std::ofstream("curved-two.prm")
      << "set Dimension = 3\nsubsection Body ring\n  set Shape = file\n  set File = "
         "curved-two.msh\nend\n"
         "subsection Body block\n  set Lower corner = 0, 0, -1\n  set Upper corner = 2, 2, 0\nend\n"
         "subsection Boundary block.front\n  set Displacement = 0; 0; 0\nend\n"
         "subsection Boundary ring.back\n  set Displacement = 0; 0; 0\nend\n";
  const Scene<3> scene = read_scene<3>("curved-two.prm", {});
  EXPECT_EQ(hexahedra_of(scene.geometry)->bent.size(), 4U);
  // The block goes on beyond the ring, and is the master.
  const Scene<3> joined =
      read_scene<3>("curved-two.prm", {{"Contact joint/Between", "ring.front, block.back"}});
  ASSERT_EQ(joined.pairs.size(), 1U);
  EXPECT_EQ(joined.pairs[0].slave, 0U);
  EXPECT_FALSE(joined.boundaries[joined.pairs[0].parts[0]].gap);
  std::filesystem::remove("curved-two.prm");
  std::filesystem::remove("curved-two.msh");
}
} // namespace
