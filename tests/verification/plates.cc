// SPDX-License-Identifier: LGPL-2.1-or-later
// Rigid plates: boundaries that move as a whole, under forces and moments; and weight.
#include "discretisation.h"

#include <hpvi/plane/plates.h>
#include <hpvi/results/equilibrium.h>

#include <cmath>
#include <numeric>

namespace
{
using namespace verification;

using Amounts = std::array<double, 3>;

/** A skew body whose right side is glued to a plate: what each motion of it is given. */
Overrides skew(const Overrides &plate)
{
  Overrides entries = {given::quadrilateral("Geometry", "0, 0; 4, 1; 3.2, 3; -0.5, 2", "3, 2"),
                       {"Material/Young's modulus", "10"},
                       {"Boundary left/Displacement", "0; 0"},
                       {"Boundary top/Pressure", "0.1*x"},
                       {"Boundary right/Rigid", "true"}};
  entries.insert(entries.end(), plate.begin(), plate.end());
  return entries;
}

struct Plated
{
  Amounts q;
  double J;
  PlateState<2> state;
  Tensor<1, 2> force;
  double farthest = 0; ///< of a node on the plate from where the plate takes it
};

Plated solve(const Scene<2> &scene, const RandomMesh &mesh, const std::string &name = "right")
{
  const Laboratory laboratory(scene, mesh);
  const Solution<2> solution = laboratory.solve();
  const auto nodes =
      supported_nodes(scene, solution.displacement_space.numbering(), solution.tables);
  const Plate plate = plates_of(scene, nodes).front();
  Plated result;
  result.q = plate.amounts(solution.u);
  result.J = 0.5 * internal_forces(scene, solution.displacement_space, solution.tables, solution.u)
                       .energy_product -
             laboratory.system.work(solution.u);
  for (const SupportedNode<2> &node : nodes)
    if (node.is_on_plate)
      for (unsigned int c = 0; c < 2; ++c)
      {
        double rigid = 0;
        for (unsigned int m = 0; m < 3; ++m)
          rigid += result.q[m] * plate.motion().motion(m, node.x)[c];
        result.farthest = std::max(result.farthest, std::abs(rigid - solution.u[node.dofs[c]]));
      }
  const Equilibrium<2> balance = equilibrium<2>(scene, nodal_forces(solution, laboratory.system));
  EXPECT_LT(balance.force_imbalance, 1e-11);
  EXPECT_LT(balance.moment_imbalance, 1e-11);
  result.state = balance.plates.front();
  for (const BoundaryForce<2> &reaction : balance.reactions)
    if (reaction.boundary == name)
      result.force = reaction.force;
  return result;
}

/** On meshes with hanging nodes and any degrees. */
TEST(Plates, MoveAsOne)
{
  const Scene<2> scene =
      scene_of(skew({{"Boundary right/Force", "3; -1"}, {"Boundary right/Moment", "2"}}));
  for (const unsigned int seed : {1U, 2U, 3U})
  {
    const Plated plated = solve(scene, RandomMesh(scene, seed, 2));
    EXPECT_LT(plated.farthest, 1e-12);
    EXPECT_NEAR(plated.force[0], 3, 1e-10);
    EXPECT_NEAR(plated.force[1], -1, 1e-10);
    EXPECT_NEAR(plated.state.moment, 2, 1e-10);
  }
}

/**
 * Pieces of a quarter and a half of a side with a gap between them: their mean point is not halfway between their ends, and
 * what turns about it and what pushes there is.
 */
TEST(Plates, OfUnequalPiecesActAtTheirMeanPoint)
{
  const Overrides jaw = {given::quadrilateral("Geometry", "0, 0; 4, 1; 3.2, 3; -0.5, 2", "3, 4"),
                         {"Material/Young's modulus", "10"},
                         {"Boundary left/Displacement", "0; 0"},
                         {"Boundary top/Pressure", "0.1*x"},
                         {"Boundary jaw/On", "right"},
                         {"Boundary jaw/Where", "(y - 1.5)*(y - 2)"},
                         {"Boundary jaw/Rigid", "true"}};
  const auto with = [&](const Overrides &plate)
  {
    Overrides entries = jaw;
    entries.insert(entries.end(), plate.begin(), plate.end());
    return scene_of(entries);
  };
  const Scene<2> pushed = with({{"Boundary jaw/Force", "3; -1"}, {"Boundary jaw/Moment", "2"}});
  const double mean = (0.25 * 0.125 + 0.5 * 0.75) / 0.75; // of the way up
  for (const unsigned int seed : {1U, 2U})
  {
    const RandomMesh mesh(pushed, seed, 2);
    const Plated free = solve(pushed, mesh, "jaw");
    EXPECT_LT(free.state.centre.distance(Point<2>(4 - 0.8 * mean, 1 + 2 * mean)), 1e-12);
    EXPECT_GT(std::abs(free.q[2]), 0.1);
    EXPECT_LT(free.farthest, 1e-12);
    EXPECT_NEAR(free.force[0], 3, 1e-10);
    EXPECT_NEAR(free.force[1], -1, 1e-10);
    EXPECT_NEAR(free.state.moment, 2, 1e-10);
    const Plated held = solve(
        with({{"Boundary jaw/Displacement", in_digits(free.q[0]) + "; " + in_digits(free.q[1])},
              {"Boundary jaw/Rotation", in_digits(free.q[2])}}),
        mesh, "jaw");
    EXPECT_NEAR(held.force[0], 3, 1e-9);
    EXPECT_NEAR(held.state.moment, 2, 1e-9);
  }
}

/** The plate that a force has moved, held there, exerts that force; for each choice of what is prescribed. */
TEST(Plates, ForcesAndMotionsAreTheSame)
{
  const Scene<2> pushed =
      scene_of(skew({{"Boundary right/Force", "3; -1"}, {"Boundary right/Moment", "2"}}));
  const RandomMesh mesh(pushed, 5, 2);
  const Plated free = solve(pushed, mesh);
  const std::array<std::string, 3> forces{{"3", "-1", "2"}};
  for (unsigned int held = 1; held < 8; ++held)
  {
    const auto is_held = [&](const unsigned int m) { return (held >> m & 1) != 0; };
    const auto motion = [&](const unsigned int m)
    { return is_held(m) ? in_digits(free.q[m]) : "free"; };
    const auto force = [&](const unsigned int m) { return is_held(m) ? "free" : forces[m]; };
    const Plated same =
        solve(scene_of(skew({{"Boundary right/Displacement", motion(0) + "; " + motion(1)},
                             {"Boundary right/Force", force(0) + "; " + force(1)},
                             {"Boundary right/Rotation", motion(2)},
                             {"Boundary right/Moment", force(2)}})),
              mesh);
    for (unsigned int m = 0; m < 3; ++m)
      EXPECT_NEAR(same.q[m], free.q[m], 1e-11) << held;
    EXPECT_NEAR(same.force[0], 3, 1e-9) << held;
    EXPECT_NEAR(same.force[1], -1, 1e-9) << held;
    EXPECT_NEAR(same.state.moment, 2, 1e-9) << held;
    double work = 0; // of what is prescribed now
    for (unsigned int m = 0; m < 3; ++m)
      work += is_held(m) ? std::stod(forces[m]) * free.q[m] : 0.;
    EXPECT_NEAR(same.J, free.J + work, 1e-10) << held;
  }
}

/** A stiff layer in the place of the plate: the limit. */
TEST(Plates, AreTheLimitOfStiffLayers)
{
  const auto energy = [](const Overrides &more)
  {
    Overrides entries = {{"Geometry/Subdivisions", "4, 4"},
                         {"Boundary bottom/Displacement", "0; 0"},
                         given::steps("hup3", "2")};
    entries.insert(entries.end(), more.begin(), more.end());
    double J = 0;
    each_step<2>(scene_of(entries), [&](const StepReport<2> &step) { J = step.energies.energy; });
    return J;
  };
  const double rigid =
                   energy({given::box("1, 0.75", "4, 3"),
                           {"Boundary top/Rigid", "true"},
                           {"Boundary top/Force", "0.5; -1"},
                           {"Boundary top/Moment", in_digits(-0.5 / 4)}}), // the lever of the layer
      stiff = energy({{"Material top/Young's modulus", "1e7"},
                      {"Material top/Where", "y - 0.75"},
                      {"Boundary top/Traction", "0.5; -1"}});
  EXPECT_NEAR(stiff / rigid, 1, 1e-5);
}

/** Coulomb friction below a block that a plate pushes: it sticks, and slips beyond mu F. */
TEST(Plates, PushABlockUntilItSlips)
{
  const auto push = [](const double horizontal)
  {
    last_step<2>(scene_of({given::box("4, 1", "8, 2"),
                           {"Material/Young's modulus", "100"},
                           {"Boundary bottom/Contact", "unilateral"},
                           {"Boundary bottom/Friction coefficient", "0.3"},
                           {"Boundary top/Rigid", "true"},
                           {"Boundary top/Force", in_digits(horizontal) + "; -10"},
                           given::steps("hpa3", "3")}),
                 [&](const StepReport<2> &step)
                 {
                   EXPECT_NEAR(step.contact.front().normal_resultant, -10, 1e-8);
                   EXPECT_NEAR(step.equilibrium.plates.front().moment, 0, 1e-8);
                 });
  };
  EXPECT_NO_THROW(push(2.9));
  EXPECT_THROW(push(3.1), NumericalFailure);
}
/**
 * A cantilever under its own weight: with w = rho g h it has the energy `w^2 L^5/(40 E I) + 3 w^2 L^3/(15 G h)` by Timoshenko's theory of
 * beams, with 5/6 of the shear; what is left falls with the square of h/L.
 */
TEST(Weight, BendsACantileverAsTimoshenkoSays)
{
  std::vector<double> errors;
  for (const double length : {8., 16.})
  {
    double J = 0;
    each_step<2>(scene_of({given::box(in_digits(length) + ", 1", in_digits(length) + ", 1"),
                           given::elastic("1000", "0.25"),
                           {"Material/Plane", "stress"},
                           {"Material/Density", "2"},
                           {"Body force/Gravity", "0; -0.005"},
                           {"Boundary left/Displacement", "0; 0"},
                           given::steps("hpa3", "6")}),
                 [&](const StepReport<2> &step) { J = step.energies.energy; });
    const double w = 0.01, EI = 1000. / 12, G = 400;
    const double energy =
        w * w * std::pow(length, 5) / (40 * EI) + w * w * std::pow(length, 3) / (6 * G * 5 / 6);
    errors.push_back(std::abs(-J / energy - 1));
  }
  EXPECT_LT(errors[0], 0.01);
  EXPECT_LT(errors[1], 0.5 * errors[0]);
}
} // namespace
