// SPDX-License-Identifier: LGPL-2.1-or-later
// Rigid plates in space: they move as one, under forces and moments, and as statics says.
#include "grid.h"

#include <hpvi/base/input_error.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/space/support_constraints.h>

#include <array>

namespace
{
using namespace space;

using Amounts = std::array<double, 6>; ///< U and phi, or force and moment

/** A slab that its right side holds, and a plate on the left with these entries. */
Scene<3> glued(const Overrides &plate)
{
  Overrides entries{{"Geometry/Subdivisions", "2, 2, 1"},
                    {"Boundary left/Traction", ""},
                    {"Boundary bottom/Contact", "none"},
                    {"Boundary bottom/Friction bound", ""},
                    {"Boundary top/Pressure", "0.1*x + 0.05*z"},
                    {"Boundary left/Rigid", "true"},
                    given::steps("hap2", "2")};
  return slab(entries + plate);
}

const Overrides pushed{{"Boundary left/Force", "3; -1; 0.5"},
                       {"Boundary left/Moment", "1; -2; 0.7"}};

struct Plated
{
  Amounts q, force;
  double J, work;      ///< J(u_N) and L(u_N)
  double farthest = 0; ///< of a node on the plate from where the plate takes it
  std::size_t n_cells;
};

Plated last_of(const Scene<3> &scene, const std::string &name = "left")
{
  Plated result{};
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                EXPECT_LT(step.equilibrium.force_imbalance, 1e-9);
                EXPECT_LT(step.equilibrium.moment_imbalance, 1e-9);
                const PlateState<3> &plate = step.equilibrium.plates.at(0);
                for (const BoundaryForce<3> &reaction : step.equilibrium.reactions)
                  for (unsigned int c = 0; reaction.boundary == name && c < 3; ++c)
                    result.force[c] = reaction.force[c];
                for (unsigned int c = 0; c < 3; ++c)
                {
                  result.q[c] = plate.displacement[c];
                  result.q[3 + c] = plate.rotation[c];
                  result.force[3 + c] = plate.moment[c];
                }
                result.J = step.energies.lagrangian;
                result.n_cells = step.size.n_cells;
                const PrimalSpace<3> &space = step.primal->space;
                result.farthest = 0;
                for (const auto &node : plate_nodes(scene, space.dof_handler, space.tables))
                {
                  Tensor<1, 3> rigid;
                  for (unsigned int m = 0; m < 6; ++m)
                    rigid += result.q[m] * space.plates.at(0).motion.motion(m, node.x);
                  for (unsigned int c = 0; c < 3; ++c)
                    result.farthest = std::max(result.farthest,
                                               std::abs(rigid[c] - step.primal->u(node.dofs[c])));
                }
              });
  return result;
}

void expect_equal(const Amounts &one, const Amounts &other, const double tolerance)
{
  for (unsigned int m = 0; m < 6; ++m)
    EXPECT_NEAR(one[m], other[m], tolerance) << m;
}

constexpr Amounts given_forces{{3, -1, 0.5, 1, -2, 0.7}};

/** On meshes with hanging nodes, whatever solves the linear systems; the last has too many coarse cells to factorise. */
TEST(PlatesInSpace, MoveAsOneByAllSolvers)
{
  for (const Overrides &entries :
       {Overrides(), given::steps("hap3", "2"),
        Overrides{{"Geometry/Subdivisions", "5, 5, 3"}, {"Adaptivity/Maximum steps", "1"}}})
  {
    std::vector<Plated> found;
    for (const char *const linear : {"multigrid", "amg", "direct"})
    {
      const Scene<3> scene = glued(pushed + entries + Overrides{{"Solver/Linear", linear}});
      steps_of<3>(
          scene,
          [&](const StepReport<3> &step)
          {
            EXPECT_FALSE(step.primal->newton.fell_back) << linear;
            EXPECT_LT(step.primal->newton.cg_steps, linear == std::string("amg") ? 100u : 20u)
                << linear;
          });
      found.push_back(last_of(scene));
      EXPECT_LT(found.back().farthest, 1e-12);
      expect_equal(found.back().force, given_forces, 1e-9);
      expect_equal(found.back().q, found[0].q, 1e-9);
      EXPECT_NEAR(found.back().J, found[0].J, 1e-9 * std::abs(found[0].J));
    }
  }
}

/** Of a part of a side, beside which larger cells are free: an edge of theirs is the plate's. */
TEST(PlatesInSpace, MayBePartsOfSides)
{
  Overrides jaw{{"Boundary left/Rigid", "false"},          {"Boundary jaw/On", "left"},
                {"Boundary jaw/Where", "(y - 2)*(z - 1)"}, {"Boundary jaw/Rigid", "true"},
                {"Geometry/Subdivisions", "2, 2, 2"},      given::steps("hap2", "3")};
  for (const auto &[entry, value] : pushed)
    jaw.emplace_back("Boundary jaw" + entry.substr(13), value);
  const Plated plated = last_of(glued(jaw), "jaw");
  EXPECT_GT(plated.n_cells, 8u);
  EXPECT_LT(plated.farthest, 1e-12);
  expect_equal(plated.force, given_forces, 1e-9);
}

/** The plate that a force has moved, held there, exerts that force; for choices of what is prescribed. */
TEST(PlatesInSpace, ForcesAndMotionsAreTheSame)
{
  const Plated free = last_of(glued(pushed));
  for (const unsigned int held : {1u, 2u, 9u, 20u, 42u, 56u, 62u, 63u})
  {
    const auto all = [&](const unsigned int first, const Amounts &amounts, const bool of_held)
    {
      std::string text;
      for (unsigned int m = first; m < first + 3; ++m)
        text += (m == first ? "" : "; ") +
                ((held >> m & 1) == of_held ? in_digits(amounts[m]) : std::string("free"));
      return text;
    };
    const Plated same = last_of(glued({{"Boundary left/Displacement", all(0, free.q, true)},
                                       {"Boundary left/Rotation", all(3, free.q, true)},
                                       {"Boundary left/Force", all(0, given_forces, false)},
                                       {"Boundary left/Moment", all(3, given_forces, false)}}));
    expect_equal(same.q, free.q, 1e-10);
    expect_equal(same.force, given_forces, 1e-8);
    double work = 0; // of what is prescribed now
    for (unsigned int m = 0; m < 6; ++m)
      work += (held >> m & 1) != 0 ? given_forces[m] * free.q[m] : 0.;
    EXPECT_NEAR(same.J, free.J + work, 1e-9) << held;
  }
}

/** A slab without its own loads and contact, clamped at its bottom, a plate on its top. */
const Overrides clamped_below{{"Boundary left/Traction", ""},
                              {"Boundary right/Displacement", ""},
                              {"Boundary bottom/Contact", "none"},
                              {"Boundary bottom/Friction bound", ""},
                              {"Boundary bottom/Displacement", "0; 0; 0"},
                              {"Boundary top/Rigid", "true"}};

/** Of a block on its bottom: with nu = 0 its sections stay plane, and fields are of degree two. */
TEST(PlatesInSpace, PressAndBendABlockAsStaticsSays)
{
  const double E = 100, L = 2, a = 3, b = 1.5, F = -4, Mx = 2, Mz = 0.6;
  Scene<3> scene = slab({given::box("3, 2, 1.5", "2, 1, 1"),
                         given::elastic("100", "0"),
                         clamped_below,
                         {"Boundary top/Force", "0; -4; 0"},
                         {"Boundary top/Moment", "2; 0; 0.6"},
                         given::steps("hup2", "1")});
  const Plated plated = last_of(scene, "top");
  const double about_x = Mx * L / (E * a * b * b * b / 12),
               about_z = Mz * L / (E * b * a * a * a / 12);
  expect_equal(plated.q,
               {{-about_z * L / 2, F * L / (E * a * b), about_x * L / 2, about_x, 0, about_z}},
               1e-11);
  expect_equal(plated.force, {{0, F, 0, Mx, 0, Mz}}, 1e-9);
}

/** A central force keeps it level whatever Poisson's ratio is, one beside the centre tilts it as its moment does. */
TEST(PlatesInSpace, TiltUnderEccentricForces)
{
  const auto press = [](const std::string &moment)
  {
    return last_of(slab({given::box("2, 1, 2", "2, 1, 2"),
                         clamped_below,
                         {"Boundary top/Force", "free; -1; free"},
                         {"Boundary top/Moment", moment},
                         given::steps("hup2", "1")}),
                   "top");
  };
  const Plated level = press(""), tilted = press("0.3; 0; 0"), other = press("0; 0; -0.3");
  for (const unsigned int m : {0, 2, 3, 4, 5})
    EXPECT_NEAR(level.q[m], 0, 1e-12);
  EXPECT_LT(level.q[1], -0.005);
  EXPECT_NEAR(tilted.q[1], level.q[1], 1e-12);
  EXPECT_GT(tilted.q[3], 1e-3);
  EXPECT_NEAR(tilted.q[3], -other.q[5], 1e-12); // the block is square
  EXPECT_NEAR(tilted.q[2], other.q[0], 1e-12);
}

/** Prescribed rotations about each axis, which alone do work: half of the moment times the angle is the energy. */
TEST(PlatesInSpace, MomentsOfPrescribedRotationsDoTheWork)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    std::string rotation = "0; 0; 0";
    rotation.replace(3 * axis, 1, "0.02");
    const Plated turned = last_of(glued({{"Boundary top/Pressure", ""},
                                         {"Boundary left/Displacement", "0; 0; 0"},
                                         {"Boundary left/Rotation", rotation}}));
    EXPECT_NEAR(turned.q[3 + axis], 0.02, 1e-14);
    EXPECT_GT(turned.J, 1e-4);
    EXPECT_NEAR(0.5 * 0.02 * turned.force[3 + axis], turned.J, 1e-9 * turned.J);
  }
}

/** Two plates on the same body, and the last one of its supports: each has its own motions. */
TEST(PlatesInSpace, TwoOfThem)
{
  const Scene<3> scene = glued(pushed + Overrides{{"Boundary top/Pressure", ""},
                                                  {"Boundary right/Displacement", ""},
                                                  {"Boundary right/Rigid", "true"},
                                                  {"Boundary right/Displacement", "0; 0; 0"},
                                                  {"Boundary right/Rotation", "0; 0; 0"}});
  const Plated one = last_of(scene),
               other = last_of(glued(pushed + Overrides{{"Boundary top/Pressure", ""}}));
  expect_equal(one.q, other.q, 1e-10);
  EXPECT_NEAR(one.J, other.J, 1e-10);
}

/** Coulomb friction below a block that a plate pushes: it sticks, and slips beyond mu F; nothing else holds it. */
TEST(PlatesInSpace, PushABlockUntilItSlips)
{
  const auto push = [](const std::string &force)
  {
    Scene<3> scene = read_scene<3>("prm/block-space.prm",
                                   Overrides{{"Geometry/Subdivisions", "2, 1, 2"},
                                             {"Body force/Expression", ""},
                                             {"Boundary bottom/Friction coefficient", "0.3"},
                                             {"Boundary top/Rigid", "true"},
                                             {"Boundary top/Force", force},
                                             given::steps("hap2", "1")});
    scene.solver.primal_tolerance = 1e-10;
    steps_of<3>(scene,
                [&](const StepReport<3> &step)
                {
                  EXPECT_NEAR(step.contact.front().normal_resultant, -10, 1e-6);
                  EXPECT_LT(step.equilibrium.plates.front().moment.norm(), 1e-7);
                  EXPECT_LT(step.equilibrium.moment_imbalance, 1e-7);
                });
  };
  EXPECT_NO_THROW(push("2; -10; 2"));
  EXPECT_NE(failure_of<NumericalFailure>([&] { push("2.2; -10; 2.2"); }).find("sliding"),
            std::string::npos);
}

/** A plate that is free to move is no support. */
TEST(PlatesInSpace, HoldWhatTheyPrescribe)
{
  const Overrides alone{{"Boundary right/Displacement", ""},
                        {"Boundary left/Displacement", "0; 0; 0"}};
  EXPECT_NE(failure_of<InputError>(
                [&] {
                  glued(alone + Overrides{{"Boundary left/Rotation", "0; free; 0"}});
                })
                .find("rotation about an axis along (0, 1, 0)"),
            std::string::npos);
  EXPECT_NO_THROW(glued(alone + Overrides{{"Boundary left/Rotation", "0; 0; 0"}}));
}

Point<3> centre_of_top(const Grid &grid, const std::string &name)
{
  const Scene<3> scene = scene_of(grid, name,
                                  {{"Boundary bottom/Displacement", "0; 0; 0"},
                                   {"Boundary top/Rigid", "true"},
                                   {"Boundary top/Force", "0; -1; 0"},
                                   {"Solver/Primal tolerance", "1e-11"},
                                   given::steps("hup2", "1")});
  Point<3> result;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                result = step.equilibrium.plates.at(0).centre;
                EXPECT_LT(step.equilibrium.plates.at(0).moment.norm(), 1e-8);
                EXPECT_LT(step.equilibrium.force_imbalance, 1e-9);
              });
  return result;
}

/** The mean point of faces that are no parallelograms, and of curved ones, here a quarter of a turn about x = z = 0. */
TEST(PlatesInSpace, ActAtTheMeanPointOfAnyFaces)
{
  const Map taper = [](const Point<3> &x) { return Point<3>(x[0], x[1], x[2] * (1 + x[0])); };
  EXPECT_LT(
      centre_of_top({{{2, 1, 2}}, taper}, "plates-taper").distance(Point<3>(5. / 9, 1, 7. / 9)),
      1e-12);
  const Map bow = [](const Point<3> &x)
  { return Point<3>(x[0], x[1] * (1 + 0.3 * x[0] * (1 - x[0])), x[2]); };
  double arc = 0, height = 0; // of y = 1 + 0.3 x (1 - x)
  const QGauss<1> rule(20);
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const double x = rule.point(q)[0], ds = rule.weight(q) * std::hypot(1., 0.3 * (1 - 2 * x));
    arc += ds;
    height += ds * (1 + 0.3 * x * (1 - x));
  }
  EXPECT_LT(centre_of_top({{{1, 1, 1}}, bow, false, Grid::everywhere, 27}, "plates-bow")
                .distance(Point<3>(0.5, height / arc, 0.5)),
            1e-8);
}
} // namespace
