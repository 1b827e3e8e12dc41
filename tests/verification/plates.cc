// SPDX-License-Identifier: LGPL-2.1-or-later
// Rigid plates: boundaries that move as a whole, under forces and moments.
#include "discretisation.h"

#include <hpvi/body/plates.h>
#include <hpvi/evaluation/equilibrium.h>

#include <cmath>
#include <numeric>

namespace
{
using namespace verification;

using Amounts = std::array<double, 3>;

/** A skew body whose right side is glued to a plate: what each motion of it is given. */
Overrides skew(const Overrides &plate)
{
  Overrides entries = {
      {"Geometry/Shape", "quadrilateral"},    {"Geometry/Corners", "0, 0; 4, 1; 3.2, 3; -0.5, 2"},
      {"Geometry/Subdivisions", "3, 2"},      {"Material/Young's modulus", "10"},
      {"Boundary left/Displacement", "0; 0"}, {"Boundary top/Pressure", "0.1*x"},
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

Plated solve(const Scene<2> &scene, const RandomMesh &mesh)
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
    if (reaction.boundary == "right")
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
    const auto motion = [&](const unsigned int m) { return is_held(m) ? text(free.q[m]) : "free"; };
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
                         {"Adaptivity/Method", "hup3"},
                         {"Adaptivity/Maximum steps", "2"}};
    entries.insert(entries.end(), more.begin(), more.end());
    double J = 0;
    AdaptiveSolver<2>(scene_of(entries))
        .run([&](const StepReport<2> &step) { J = step.energies.energy; });
    return J;
  };
  const double rigid = energy({{"Geometry/Upper corner", "1, 0.75"},
                               {"Geometry/Subdivisions", "4, 3"},
                               {"Boundary top/Rigid", "true"},
                               {"Boundary top/Force", "0.5; -1"},
                               {"Boundary top/Moment", text(-0.5 / 4)}}), // the lever of the layer
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
    AdaptiveSolver<2>(scene_of({{"Geometry/Upper corner", "4, 1"},
                                {"Geometry/Subdivisions", "8, 2"},
                                {"Material/Young's modulus", "100"},
                                {"Boundary bottom/Contact", "unilateral"},
                                {"Boundary bottom/Friction coefficient", "0.3"},
                                {"Boundary top/Rigid", "true"},
                                {"Boundary top/Force", text(horizontal) + "; -10"},
                                {"Adaptivity/Method", "hpa3"},
                                {"Adaptivity/Maximum steps", "3"}}))
        .run(
            [&](const StepReport<2> &step)
            {
              if (step.stopped_by.empty())
                return;
              EXPECT_NEAR(step.contact.front().normal_resultant, -10, 1e-8);
              EXPECT_NEAR(step.equilibrium.plates.front().moment, 0, 1e-8);
            });
  };
  EXPECT_NO_THROW(push(2.9));
  EXPECT_THROW(push(3.1), NumericalFailure);
}
} // namespace
