// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies of hexahedra from mesh files, which the tests write themselves: cells that are no boxes, corners in any order.
#include "grid.h"

#include <hpvi/base/input_error.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/reader/gmsh/hexahedral_file.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

namespace
{
using namespace space;

Point<3> fan(const Point<3> &x)
{
  return {4 * x[0] + 2.4 * (x[2] - 0.5) * x[0] * (1 - x[0]), 2 * x[1], 4 * x[2]};
}

Point<3> frustum(const Point<3> &x)
{
  const double width = 4 * (1 - 0.3 * x[1]);
  return {width * (x[0] - 0.5), 2 * x[1], width * (x[2] - 0.5)};
}

Point<3> turned(const Point<3> &x)
{
  const double c = std::cos(0.5), s = std::sin(0.5), d = std::cos(0.3), t = std::sin(0.3);
  const Point<3> y(c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]);
  return {y[0], d * y[1] - t * y[2], t * y[1] + d * y[2]};
}

/** u = s + b (n . x) slips uniformly along the bottom, whose normal is n, by s of length 1: under g = 1 friction is -s. */
TEST(Hexahedra, HaveConstantStressAndUniformSlip)
{
  const Tensor<1, 3> b({0.1, -0.2, 0.13});
  const std::vector<Map> maps{fan, frustum, [](const Point<3> &x) { return turned(fan(x)); },
                              [](const Point<3> &x) { return turned(frustum(x)); }};
  for (const Map &map : maps)
    for (const unsigned int degree : {2U, 3U})
    {
      Scene<3> scene = scene_of({{{2, 2, 2}}, map, true}, "hexahedra-patch");
      scene.adaptivity.start_degree = degree;
      scene.adaptivity.maximum_steps = 1;
      scene.geometry.graded_towards = {map(Point<3>(0, 0, 0)), map(Point<3>(1, 1, 0))};
      scene.geometry.grading_levels = 1;
      scene.solver.primal_tolerance = 1e-12;
      const std::vector<Side<3>> sides = sides_of(scene.geometry);
      BoundaryCondition<3> &bottom = scene.boundary("bottom");
      const Tensor<1, 3> n = sides[bottom.id].outward;
      Tensor<1, 3> slip = sides[bottom.id].pieces[0][1] - sides[bottom.id].pieces[0][0];
      slip /= slip.norm();
      const Point<3> origin = map(Point<3>());
      const Tensor<2, 3> B = outer_product(b, n);
      const KnownField<3> exact{[=](const Point<3> &x) { return B * (x - origin) + slip; },
                                [=](const Point<3> &) { return B; }};
      bottom.contact = Contact::tangential;
      bottom.friction.bound = expression<3>(1.);
      for (BoundaryCondition<3> &boundary : scene.boundaries)
        if (sides[boundary.id].is_flat() && boundary.name != "top" && boundary.name != "front")
        {
          const Tensor<1, 3> load =
              HookesLaw<3>(scene.materials[0]).traction(B, sides[boundary.id].outward) +
              (boundary.id == bottom.id ? slip : Tensor<1, 3>());
          for (unsigned int c = 0; c < 3; ++c)
          {
            boundary.displacement[c] = nullptr;
            boundary.traction[c] = expression<3>(load[c]);
          }
        }
        else
          prescribe(boundary, exact);
      steps_of<3>(scene,
                  [&](const StepReport<3> &step)
                  {
                    const Point<3> unit(0.3, 0.6, 0.2);
                    EXPECT_TRUE(
                        step.primal->space.dof_handler.get_triangulation().has_hanging_nodes());
                    for (const auto &cell : step.primal->space.dof_handler.active_cell_iterators())
                      EXPECT_LT((step.field.values(cell, {unit})[0].displacement -
                                 exact.value(map_of<3>(cell).point(unit)))
                                    .norm(),
                                1e-9);
                    EXPECT_LT(step.norms.total, 1e-8);
                    EXPECT_NEAR(step.energies.slack, 0, 1e-9); // friction works with its bound
                    EXPECT_EQ(step.primal->newton.n_slipping, step.contact.at(0).points.size());
                    for (const ContactPoint<3> &point : step.contact.at(0).points)
                      EXPECT_LT((point.lambda - slip).norm(), 1e-9);
                  });
    }
}

/** A uniform pressure presses on a plane that is not parallel to the face, whose measure varies. */
TEST(Hexahedra, RestOnAGapThatVaries)
{
  const Map map = [](const Point<3> &x) { return turned(fan(x)); };
  Scene<3> scene = scene_of({{{2, 2, 2}}, map, true}, "hexahedra-gap");
  scene.adaptivity.maximum_steps = 1;
  scene.solver.primal_tolerance = 1e-12;
  BoundaryCondition<3> &bottom = scene.boundary("bottom");
  const Tensor<1, 3> n = sides_of(scene.geometry)[bottom.id].outward;
  const Tensor<2, 3> B({{-0.1, -0.02, 0.03}, {0.02, -0.1, 0.04}, {-0.03, -0.04, -0.1}});
  const KnownField<3> exact{[=](const Point<3> &x) { return B * x; },
                            [=](const Point<3> &) { return B; }};
  for (BoundaryCondition<3> &boundary : scene.boundaries)
    if (boundary.id != bottom.id)
      prescribe(boundary, exact);
  bottom.contact = Contact::unilateral;
  bottom.gap = expression<3>(
      std::function<double(const Point<3> &)>([=](const Point<3> &x) { return n * (B * x); }));
  const double pressure = -(HookesLaw<3>(scene.materials[0]).traction(B, n) * n);
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                for (const ContactPoint<3> &point : step.contact.at(0).points)
                  EXPECT_NEAR(point.normal_traction, -pressure, 1e-9 * pressure);
              });
}

/** prm/dome.prm as a file of boxes, their corners in any order, and turned: the same J, meshes and points. */
TEST(Hexahedra, OfABoxAreTheBox)
{
  Scene<3> box = read_scene<3>("prm/dome.prm", {{"Adaptivity/Maximum unknowns", "1500"}});
  box.solver.primal_tolerance = 1e-11;
  const std::vector<Step> expected = steps_of<3>(box);
  const Map place = [](const Point<3> &x) { return Point<3>(2 * x[0] - 1, x[1], 2 * x[2] - 1); };
  for (const bool is_rotated : {false, true})
    for (const LinearMethod linear : {LinearMethod::multigrid, LinearMethod::direct})
    {
      Scene<3> scene =
          scene_of({{{4, 2, 4}},
                    is_rotated ? Map([&](const Point<3> &x) { return turned(place(x)); }) : place,
                    true},
                   "hexahedra-box");
      const auto back = [is_rotated](const Point<3> &x)
      {
        Tensor<1, 3> result = x;
        for (unsigned int d = 0; d < 3 && is_rotated; ++d)
        {
          Point<3> e;
          e[d] = 1;
          result[d] = turned(e) * x;
        }
        return Point<3>(result);
      };
      scene.materials = box.materials;
      scene.adaptivity = box.adaptivity;
      scene.solver = box.solver;
      scene.solver.linear = linear;
      for (const char *const name : {"top", "bottom"})
      {
        const BoundaryCondition<3> &from = box.boundary(name);
        BoundaryCondition<3> &to = scene.boundary(name);
        to.contact = from.contact;
        const auto moved = [&](const Expression<3> &f) -> Expression<3>
        {
          return f ? expression<3>(std::function<double(const Point<3> &)>(
                         [f, back](const Point<3> &x) { return f->value(back(x)); }))
                   : nullptr;
        };
        to.gap = moved(from.gap);
        to.friction.bound = moved(from.friction.bound);
        const Point<3> u =
            is_rotated ? turned(Point<3>(0.01, -0.05, 0.005)) : Point<3>(0.01, -0.05, 0.005);
        for (unsigned int c = 0; c < 3 && from.has_displacement(); ++c)
          to.displacement[c] = expression<3>(u[c]);
      }
      const std::vector<Step> steps = steps_of<3>(scene);
      ASSERT_EQ(steps.size(), expected.size());
      for (unsigned int k = 0; k < steps.size(); ++k)
      {
        EXPECT_EQ(steps[k].n_cells, expected[k].n_cells);
        EXPECT_EQ(steps[k].n_slipping, expected[k].n_slipping);
        EXPECT_EQ(steps[k].n_pressing, expected[k].n_pressing);
        EXPECT_NEAR(steps[k].energy, expected[k].energy,
                    1e-10 * expected[k].norm * expected[k].norm);
        EXPECT_NEAR(steps[k].estimate, expected[k].estimate, 1e-8 * expected[k].estimate);
      }
    }
}

/** A block between three planes of symmetry, which meet in edges and a corner, pushed and heated: as it lies, and turned. */
TEST(Hexahedra, StandBetweenPlanesOfSymmetryOfAnyDirection)
{
  std::vector<std::vector<Step>> runs;
  std::vector<double> forces;
  for (const bool is_rotated : {false, true})
    for (const LinearMethod linear : {LinearMethod::multigrid, LinearMethod::direct})
    {
      Scene<3> scene =
          scene_of({{{2, 2, 2}},
                    is_rotated ? Map([](const Point<3> &x) { return turned(fan(x)); }) : Map(fan),
                    true},
                   "hexahedra-symmetry");
      scene.boundary("top").displacement = {};
      for (const char *const name : {"right", "bottom", "back"})
        scene.boundary(name).symmetry = true;
      scene.initial_strains.resize(1);
      scene.initial_strains[0].expansion = 0.01;
      scene.initial_strains[0].temperature = expression<3>(2.);
      scene.adaptivity.method = Method::hap2;
      scene.adaptivity.start_degree = 2;
      scene.adaptivity.maximum_steps = 3;
      scene.solver.primal_tolerance = 1e-12;
      scene.solver.linear = linear;
      const Point<3> load =
          is_rotated ? turned(Point<3>(0.05, -0.1, 0.02)) : Point<3>(0.05, -0.1, 0.02);
      for (unsigned int c = 0; c < 3; ++c)
        scene.boundary("top").traction[c] = expression<3>(load[c]);
      runs.push_back(steps_of<3>(scene,
                                 [&](const StepReport<3> &step)
                                 {
                                   EXPECT_LT(step.equilibrium.force_imbalance, 1e-8);
                                   EXPECT_LT(step.equilibrium.moment_imbalance, 1e-8);
                                   double sum = 0;
                                   for (const auto &reaction : step.equilibrium.reactions)
                                     sum += reaction.force.norm();
                                   forces.push_back(sum);
                                 }));
    }
  for (unsigned int r = 1; r < runs.size(); ++r)
  {
    ASSERT_EQ(runs[r].size(), runs[0].size());
    for (unsigned int k = 0; k < runs[r].size(); ++k)
    {
      EXPECT_EQ(runs[r][k].n_cells, runs[0][k].n_cells);
      EXPECT_EQ(runs[r][k].n_free, runs[0][k].n_free);
      EXPECT_NEAR(runs[r][k].lagrangian, runs[0][k].lagrangian,
                  1e-9 * std::abs(runs[0][k].lagrangian));
      EXPECT_NEAR(runs[r][k].estimate, runs[0][k].estimate, 1e-7 * runs[0][k].estimate);
      EXPECT_NEAR(forces[r * runs[0].size() + k], forces[k], 1e-8 * forces[k]);
    }
  }
}

/** Of so many cells that ML solves on their corners, which depend on each other where a plane is along no axis. */
TEST(Hexahedra, StandBetweenPlanesOfSymmetryOnMeshesOfManyCells)
{
  std::vector<double> energies;
  std::vector<unsigned int> cg_steps;
  for (const auto &[is_rotated, linear] : {std::pair(false, LinearMethod::multigrid),
                                           {true, LinearMethod::multigrid},
                                           {true, LinearMethod::direct}})
  {
    Scene<3> scene =
        scene_of({{{8, 4, 8}},
                  is_rotated ? Map([](const Point<3> &x) { return turned(fan(x)); }) : Map(fan)},
                 "hexahedra-many-cells");
    scene.boundary("top").displacement = {};
    for (const char *const name : {"right", "bottom", "back"})
      scene.boundary(name).symmetry = true;
    const Point<3> load = is_rotated ? turned(Point<3>(0, -0.1, 0)) : Point<3>(0, -0.1, 0);
    for (unsigned int c = 0; c < 3; ++c)
      scene.boundary("top").traction[c] = expression<3>(load[c]);
    scene.adaptivity.method = Method::hup2;
    scene.adaptivity.start_degree = 2;
    scene.adaptivity.maximum_steps = 1;
    scene.solver.primal_tolerance = 1e-11;
    scene.solver.linear = linear;
    steps_of<3>(scene,
                [&](const StepReport<3> &step)
                {
                  energies.push_back(step.energies.lagrangian);
                  cg_steps.push_back(step.primal->newton.cg_steps);
                  EXPECT_EQ(step.primal->newton.linear, linear);
                });
  }
  for (const unsigned int k : {1, 2})
    EXPECT_NEAR(energies.at(k), energies.at(0), 1e-9 * std::abs(energies.at(0)));
  EXPECT_LE(cg_steps.at(1), cg_steps.at(0) + 2);
}

/** A layer with a side that is slanted, between planes of symmetry: that of plane strain, which integrates as it does on parallelograms. */
TEST(Hexahedra, SlideAlongASlantedSideAsInThePlane)
{
  constexpr double depth = 0.5;
  Scene<2> plane =
      read_scene<2>("prm/han-6-12.prm", Overrides{{"Material/Plane", "strain"},
                                                  {"Geometry/Subdivisions", "4, 2"},
                                                  {"Boundary left/Traction", "0.3; 0.1*y"},
                                                  {"Boundary right/Displacement", ""},
                                                  {"Boundary right/Symmetry", "true"},
                                                  {"Boundary bottom/Contact", "none"},
                                                  {"Boundary bottom/Friction bound", ""},
                                                  {"Boundary bottom/Symmetry", "true"},
                                                  given::steps("hup2", "2")});
  plane.geometry.shape = Shape::quadrilateral;
  plane.geometry.corners =
      quadrilateral_corners({{Point<2>(0, 0), Point<2>(4, 0), Point<2>(5, 2), Point<2>(1, 2)}});
  Scene<3> scene = scene_of({{{4, 2, 1}},
                             [](const Point<3> &x)
                             { return Point<3>(4 * x[0] + x[1], 2 * x[1], depth * x[2]); }},
                            "hexahedra-slanted");
  scene.boundary("top").displacement = {};
  for (const char *const name : {"right", "bottom", "front", "back"})
    scene.boundary(name).symmetry = true;
  scene.boundary("left").traction[0] = expression<3>(0.3);
  scene.boundary("left").traction[1] = expression<3>(
      std::function<double(const Point<3> &)>([](const Point<3> &x) { return 0.1 * x[1]; }));
  scene.materials[0].young = plane.materials[0].young;
  scene.materials[0].poisson = plane.materials[0].poisson;
  scene.adaptivity.method = Method::hup2;
  scene.adaptivity.start_degree = 2;
  scene.adaptivity.maximum_steps = 2;
  scene.solver.primal_tolerance = 1e-12;
  std::vector<std::array<double, 3>> flat, thick;
  const auto take = [](const auto &step, const double thickness, auto &to)
  {
    to.push_back({{step.energies.lagrangian / thickness, 0., 0.}});
    for (const auto &reaction : step.equilibrium.reactions)
      for (unsigned int c = 0; reaction.boundary == "right" && c < 2; ++c)
        to.back()[1 + c] = reaction.force[c] / thickness;
  };
  AdaptiveSolver<2>(plane).run([&](const StepReport<2> &step) { take(step, 1., flat); });
  steps_of<3>(scene, [&](const StepReport<3> &step) { take(step, depth, thick); });
  ASSERT_EQ(flat.size(), thick.size());
  for (unsigned int k = 0; k < flat.size(); ++k)
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_NEAR(thick[k][i], flat[k][i], 1e-8 * std::abs(flat[k][i])) << k << " " << i;
}

/** The block of prm/block-space.prm on its slope, turned: contact alone holds it, its normal along no axis. */
TEST(Hexahedra, StandOnASlopeOfAnyDirection)
{
  Scene<3> box = read_scene<3>("prm/block-space.prm", {{"Geometry/Subdivisions", "2, 1, 2"},
                                                       {"Adaptivity/Maximum steps", "2"}});
  box.solver.primal_tolerance = 1e-11;
  const std::vector<Step> expected = steps_of<3>(box);
  Scene<3> scene =
      scene_of({{{2, 1, 2}},
                [](const Point<3> &x) { return turned(Point<3>(2 * x[0], x[1], 2 * x[2])); },
                true},
               "hexahedra-slope");
  scene.materials = box.materials;
  scene.adaptivity = box.adaptivity;
  scene.solver = box.solver;
  scene.boundary("top").displacement = {};
  scene.boundary("bottom").contact = Contact::unilateral;
  const auto stands = [&](const double coefficient)
  {
    scene.boundary("bottom").friction.coefficient = expression<3>(coefficient);
    const Point<3> weight = turned(Point<3>(0.5, -1, 0));
    for (unsigned int c = 0; c < 3; ++c)
      scene.body_force[c] = expression<3>(weight[c]);
    return steps_of<3>(scene);
  };
  const std::vector<Step> steps = stands(0.51);
  ASSERT_EQ(steps.size(), expected.size());
  for (unsigned int k = 0; k < steps.size(); ++k)
  {
    EXPECT_EQ(steps[k].n_cells, expected[k].n_cells);
    EXPECT_EQ(steps[k].n_slipping, expected[k].n_slipping);
    EXPECT_NEAR(steps[k].energy, expected[k].energy, 1e-9 * expected[k].norm * expected[k].norm);
  }
  EXPECT_THROW(stands(0.49999), NumericalFailure);
}

// ---------------------------------------------------------------- held by contact alone

/** Columns of cells over a floor of quadrilaterals, inner vertices moved anywhere by up to 0.3 of a cell, those of the rim along it. */
Map floor_of(const unsigned int n, const unsigned int seed)
{
  return [=](const Point<3> &x)
  {
    const auto shift = [&](const unsigned int axis)
    {
      std::mt19937 random(seed + 2 * std::lround(n * x[0] + (n + 1) * n * x[2]) + axis / 2);
      random.discard(7);
      const bool may_move = x[axis] > 0 && x[axis] < 1;
      return may_move ? 0.6 * (random() / 4294967296. - 0.5) / n : 0.;
    };
    return Point<3>(2 * (x[0] + shift(0)), x[1], 2 * (x[2] + shift(2)));
  };
}

struct Floor
{
  std::string name;
  unsigned int n; ///< cells in x and in z
  Map map;
  std::string law = "0.5";                 ///< a coefficient, or "bound" or "none"
  Point<3> load = Point<3>(0.1, -1, 0.05); ///< traction on the top
  bool is_graded = false;
};

/** The arms of contact dofs are centroids, which of faces that are no parallelograms are not the Gauss points. */
TEST(Hexahedra, RestOnAnyQuadrilaterals)
{
  const Map shifted = [](const Point<3> &x)
  {
    const bool moves = std::abs(x[0] - 0.5) + std::abs(x[2] - 0.5) < 0.1;
    return Point<3>(2 * x[0] + (moves ? 0.2 : 0.), x[1], 2 * x[2] + (moves ? 0.12 : 0.));
  };
  const std::vector<Floor> floors{
      {"one vertex shifted", 2, shifted},
      {"2 x 2, random", 2, floor_of(2, 1)},
      {"3 x 3, random", 3, floor_of(3, 2)},
      {"3 x 3, Tresca", 3, floor_of(3, 3), "bound"},
      {"4 x 4, near sliding", 4, floor_of(4, 4), "0.1125"},
      {"2 x 2, hanging nodes", 2, floor_of(2, 5), "0.5", Point<3>(0.1, -1, 0.05), true},
      {"2 x 2, no friction", 2, floor_of(2, 6), "none", Point<3>(0, -1, 0)},
      {"3 x 3, hanging nodes, to one side", 3, floor_of(3, 7), "0.8", Point<3>(-0.3, -1, -0.3),
       true},
      {"a fan", 2, fan},
      {"3 x 3, turned", 3, [](const Point<3> &x) { return turned(floor_of(3, 8)(x)); }}};
  for (const Floor &floor : floors)
    for (const unsigned int degree : {2U, 3U})
    {
      SCOPED_TRACE(floor.name + ", degree " + std::to_string(degree));
      Scene<3> scene = scene_of({{{floor.n, 1, floor.n}}, floor.map, true}, "hexahedra-floor");
      const Tensor<1, 3> normal = sides_of(scene.geometry)[scene.boundary("bottom").id].outward;
      scene.adaptivity.method = degree == 2 ? Method::hup2 : Method::hup3;
      scene.adaptivity.start_degree = degree;
      scene.adaptivity.maximum_steps = 1;
      scene.boundary("top").displacement = {};
      BoundaryCondition<3> &bottom = scene.boundary("bottom");
      bottom.contact = Contact::unilateral;
      if (floor.law == "bound")
        bottom.friction.bound = expression<3>(0.3);
      else if (floor.law != "none")
        bottom.friction.coefficient = expression<3>(std::stod(floor.law));
      if (floor.is_graded)
      {
        scene.geometry.graded_towards = {floor.map(Point<3>(0, 0, 0))};
        scene.geometry.grading_levels = 1;
      }
      const bool is_rotated = std::abs(normal[1] + 1) > 1e-9;
      const Point<3> load = is_rotated ? turned(floor.load) : floor.load;
      for (unsigned int c = 0; c < 3; ++c)
        scene.boundary("top").traction[c] = expression<3>(load[c]);
      steps_of<3>(scene,
                  [&](const StepReport<3> &step)
                  {
                    EXPECT_EQ(step.primal->newton.fell_back, false);
                    EXPECT_LT(step.equilibrium.force_imbalance, 1e-9);
                    EXPECT_LT(step.equilibrium.moment_imbalance, 1e-9);
                  });
    }
}

/** A skew angle of cells, which re-entrant edges and free sides leave: bisected everywhere it is the finer one. */
TEST(Hexahedra, OfAnAngleHaveTheEnergyOfNestedMeshes)
{
  const auto steps = [](const unsigned int n, const unsigned int n_steps)
  {
    Scene<3> scene =
        scene_of({{{2 * n, 2 * n, n}},
                  [](const Point<3> &x) { return Point<3>(2 * x[0] + 0.5 * x[2], 2 * x[1], x[2]); },
                  true,
                  [](const Point<3> &x) { return x[0] < 0.5 || x[1] < 0.5; }},
                 "hexahedra-angle");
    scene.boundary("top").displacement = {
        {expression<3>(0.01), expression<3>(-0.02), expression<3>(0.004)}};
    scene.boundary("right").traction = {
        {expression<3>(0.), expression<3>(-0.1), expression<3>(0.05)}};
    scene.boundary("bottom").contact = Contact::unilateral;
    scene.boundary("bottom").friction.bound = expression<3>(0.005);
    scene.adaptivity.method = Method::hup2;
    scene.adaptivity.maximum_steps = n_steps;
    scene.solver.primal_tolerance = 1e-12;
    return steps_of<3>(scene);
  };
  const Step bisected = steps(1, 2).back(), fine = steps(2, 1).back();
  EXPECT_EQ(bisected.n_cells, 24);
  EXPECT_EQ(fine.n_cells, 24);
  EXPECT_EQ(bisected.n_pressing, fine.n_pressing);
  EXPECT_GT(fine.n_slipping, 0);
  EXPECT_NEAR(bisected.lagrangian, fine.lagrangian, 1e-9 * std::abs(fine.lagrangian));
  EXPECT_NEAR(bisected.estimate, fine.estimate, 1e-6 * fine.estimate);
}

/** Plane faces around an axis that look like a cylinder are told, and where a boundary has several each. */
TEST(Hexahedra, SayWhereTheirFacesLookLikeACylinder)
{
  const auto ring = [](const double angle, const double radius, const double flat = 1)
  {
    return [=](const Point<3> &x)
    {
      const double r = radius * (1 + x[0]), a = angle * x[1] * numbers::PI / 180;
      return Point<3>(r * std::cos(a), flat * r * std::sin(a), 3 * x[2]);
    };
  };
  const auto frustums = [&](const Point<3> &x)
  {
    const Point<3> y = ring(90, 1)(x);
    return Point<3>((1 - 0.2 * x[2]) * y[0], (1 - 0.2 * x[2]) * y[1], y[2]);
  };
  struct Row
  {
    std::string name;
    Grid grid;
    std::vector<std::string> words; ///< of all remarks
  };
  const std::string along = " around (0, 0, 0) along (0, 0, 1), and the body has edges there",
                    left = "boundary left is a polygon of ",
                    right = "boundary right is a polygon of ",
                    faces = " plane faces with their vertices on a cylinder of radius ";
  const std::vector<Row> rows{
      {"a quarter",
       {{{1, 6, 1}}, ring(90, 0.8)},
       {left + "6" + faces + "0.8" + along, right + "6" + faces + "1.6" + along}},
      {"a quarter, two layers",
       {{{2, 4, 2}}, ring(90, 1), true},
       {left + "4" + faces + "1" + along, right + "4" + faces + "2" + along}},
      {"an arc",
       {{{1, 4, 1}}, ring(40, 5)},
       {left + "4" + faces + "5" + along, right + "4" + faces + "10" + along}},
      {"turned",
       {{{1, 6, 1}}, [&](const Point<3> &x) { return turned(ring(90, 0.8)(x)); }},
       {left + "6" + faces + "0.8 around (", right + "6" + faces + "1.6 around ("}},
      {"three faces", {{{1, 3, 1}}, ring(90, 1)}, {}},
      {"corners", {{{1, 4, 1}}, ring(240, 1)}, {}},
      {"an ellipse", {{{1, 6, 1}}, ring(90, 1, 0.8)}, {}},
      {"a cone", {{{1, 6, 1}}, frustums}, {}},
      {"a box", {{{3, 3, 3}}, [](const Point<3> &x) { return x; }}, {}}};
  for (const Row &row : rows)
  {
    const std::vector<std::string> remarks = scene_of(row.grid, "hexahedra-cylinder").remarks;
    ASSERT_EQ(remarks.size(), row.words.size()) << row.name;
    for (unsigned int k = 0; k < remarks.size(); ++k)
      EXPECT_EQ(remarks[k].find(row.words[k]), 0U) << row.name << ": " << remarks[k];
  }
}

/** What a mesh may not be: one line with what is wrong. */
TEST(Hexahedra, AreRefusedInOneLine)
{
  const auto refused = [](const Grid &grid)
  {
    grid.write("hexahedra-bad.msh");
    const std::string line =
        ::failure_of<InputError>([] { read_hexahedral_file("hexahedra-bad.msh"); });
    std::filesystem::remove("hexahedra-bad.msh");
    return line;
  };
  const auto identity = [](const Point<3> &x) { return x; };
  const auto has = [](const std::string &line, const std::string &words)
  { EXPECT_NE(line.find(words), std::string::npos) << line; };
  EXPECT_EQ(refused({{{2, 2, 2}}, identity, true}), "");
  EXPECT_EQ(
      refused({{{2, 1, 1}},
               [](const Point<3> &x) { return Point<3>(x[0], x[1], x[2] + 0.1 * x[0] * x[1]); }}),
      "");
  has(refused({{{1, 1, 1}},
               [](const Point<3> &x)
               { return Point<3>(x[0], x[1], x[2] + 2.4 * x[2] * (1 - x[2])); },
               false,
               Grid::everywhere,
               27}),
      "folds over itself");
  has(refused({{{1, 1, 1}},
               [](const Point<3> &x) { return Point<3>(x[0] * (1 - 1.5 * x[1]), x[1], x[2]); }}),
      "folded");
  has(refused({{{3, 1, 1}},
               identity,
               false,
               [](const Point<3> &x) { return std::abs(x[0] - 0.5) > 0.2; }}),
      "make 2 parts");
  has(refused({{{2, 1, 1}},
               [](const Point<3> &x) { return Point<3>(std::abs(x[0] - 0.5), x[1], x[2]); }}),
      "two nodes are at");
}
} // namespace
