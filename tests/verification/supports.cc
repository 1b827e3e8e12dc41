// SPDX-License-Identifier: LGPL-2.1-or-later
// Conditions that meet at one node, and the forces that they exert.
#include "discretisation.h"

#include <hpvi/plane/supports.h>

#include <algorithm>

namespace
{
using namespace verification;

/** The largest violation of any condition of any boundary at its own nodes. */
double violation(const Laboratory &discrete, const Vector<double> &u)
{
  double largest = 0;
  for (const SupportedNode<2> &node :
       supported_nodes(discrete.scene, discrete.displacement_space.numbering(), discrete.tables))
    for (const PointCondition<2> &condition : node.conditions)
      largest =
          std::max(largest, std::abs(condition.direction[0] * u[node.dofs[0]] +
                                     condition.direction[1] * u[node.dofs[1]] - condition.value));
  return largest;
}

/** A body that stands on a slope of ten degrees, leans against a wall and is pushed. */
Overrides slope()
{
  return {given::quadrilateral(
              "Geometry", "0, 0; 2, " + in_digits(2 * std::tan(numbers::PI / 18)) + "; 2, 2; 0, 2",
              "2, 2"),
          given::rough("bottom", "bilateral", "0.01"),
          {"Boundary left/Displacement", "0; free"},
          {"Boundary top/Traction", "0.1; -0.3"}};
}

TEST(Corners, ASupportDoesNotLiftTheContactBesideIt)
{
  const Scene<2> scene = scene_of(slope());
  const RandomMesh mesh(scene, 4, 2);
  const Laboratory discrete(scene, mesh);
  const Solution<2> solution = discrete.solve();
  EXPECT_LE(violation(discrete, solution.u), 1e-15);
  for (const SupportedNode<2> &node : // both cells of a vertex inside of a side say the same
       supported_nodes(scene, discrete.displacement_space.numbering(), discrete.tables))
    EXPECT_EQ(node.conditions.size(), node.x.norm() < 1e-12 ? 2u : 1u) << node.x;
  // The corner of wall and slope stays where it is; without u_n = 0 there it slides along the wall.
  for (const SupportedNode<2> &node :
       supported_nodes(scene, discrete.displacement_space.numbering(), discrete.tables))
    if (node.x.norm() < 1e-12)
    {
      EXPECT_EQ(node.conditions.size(), 2u);
      EXPECT_LE(std::abs(solution.u[node.dofs[0]]), 1e-15);
      EXPECT_LE(std::abs(solution.u[node.dofs[1]]), 1e-15);
    }
}

TEST(Corners, TwoContactsMeet)
{
  const Scene<2> scene =
      scene_of({given::quadrilateral("Geometry", "0, 0; 3, 0.4; 2.5, 2; -0.3, 1.7"),
                {"Boundary bottom/Contact", "bilateral"},
                {"Boundary left/Contact", "bilateral"},
                {"Boundary right/Traction", "0.2; -0.1"}});
  const RandomMesh mesh(scene, 5, 2);
  const Laboratory discrete(scene, mesh);
  EXPECT_LE(violation(discrete, discrete.solve().u), 1e-15);
}

/** Two sides of nearly one direction hold the node between them along their normal alone. */
TEST(Corners, DirectionsThatNearlyRepeatEachOtherCountOnce)
{
  Scene<2> scene;
  scene.geometry.shape = Shape::quadrilateral;
  scene.geometry.corners =
      quadrilateral_corners({{Point<2>(0, 0), Point<2>(1, -1e-7), Point<2>(2, 0), Point<2>(1, 1)}});
  scene.boundary("bottom").contact = scene.boundary("right").contact = Contact::bilateral;
  const RandomMesh mesh(scene, 1, 0);
  const Laboratory discrete(scene, mesh);
  unsigned int n_shared = 0;
  for (const SupportedNode<2> &node :
       supported_nodes(scene, discrete.displacement_space.numbering(), discrete.tables))
    if (node.conditions.size() == 2)
    {
      const auto &constraints = discrete.displacement_space.constraints();
      EXPECT_TRUE(constraints.is_constrained(node.dofs[1]));
      EXPECT_FALSE(constraints.is_constrained(node.dofs[0]));
      ++n_shared;
    }
  EXPECT_EQ(n_shared, 1u);
}

/** A prescribed displacement along an inclined contact, and its constraint, at one node, whichever comes first. */
TEST(Corners, PrescribedValuesAreMetTogether)
{
  const Overrides wall{given::quadrilateral("Geometry", "0, 0; 2, 0; 2, 2; 0.5, 2"),
                       {"Boundary left/Contact", "bilateral"},
                       {"Boundary bottom/Displacement", "free; 0.04"},
                       {"Boundary right/Traction", "0.1; 0"}};
  for (const auto &[entries, x, y] :
       {std::make_tuple(slope() + Overrides{{"Boundary left/Displacement", "0.03; free"}}, 0.03,
                        0.03 * std::tan(numbers::PI / 18)),
        {wall, 0.01, 0.04}}) // one along, four up
  {
    const Scene<2> scene = scene_of(entries);
    const RandomMesh mesh(scene, 6, 1);
    const Laboratory discrete(scene, mesh);
    const Solution<2> solution = discrete.solve();
    EXPECT_LE(violation(discrete, solution.u), 1e-15);
    for (const SupportedNode<2> &node :
         supported_nodes(scene, discrete.displacement_space.numbering(), discrete.tables))
      if (node.x.norm() < 1e-12)
      {
        EXPECT_NEAR(solution.u[node.dofs[0]], x, 1e-16);
        EXPECT_NEAR(solution.u[node.dofs[1]], y, 1e-16);
      }
  }
}

/** The whole scene turned: in its own axes the slope is level, and deal.II never saw a corner there. */
TEST(Corners, TurnWithTheBody)
{
  const auto run = [](const double angle)
  {
    const Tensor<1, 2> e({std::cos(angle), std::sin(angle)}), n({-e[1], e[0]});
    std::string corners;
    for (const Point<2> &x : {Point<2>(0, 0), Point<2>(2, 0), Point<2>(2, 1), Point<2>(0, 1)})
    {
      const Tensor<1, 2> y = x[0] * e + x[1] * n;
      corners += (corners.empty() ? "" : "; ") + in_digits(y[0]) + ", " + in_digits(y[1]);
    }
    const Tensor<1, 2> traction = 0.1 * e - 0.3 * n;
    const Scene<2> scene =
        scene_of({given::quadrilateral("Geometry", corners),
                  given::rough("bottom", "bilateral", "0.01"),
                  {"Boundary left/Contact", "bilateral"},
                  {"Boundary top/Traction", in_digits(traction[0]) + "; " + in_digits(traction[1])},
                  given::steps("hup3", "3")});
    double energy = 0;
    AdaptiveSolver<2>(scene).run([&](const StepReport<2> &step) { energy = step.energies.energy; });
    return energy;
  };
  const double level = run(0.);
  for (const double angle : {0.2, 1., 2.5, -0.7})
    EXPECT_NEAR(run(angle), level, 1e-10 * std::abs(level)) << angle;
}

// ---------------------------------------------------------------- equilibrium

/** A block of 2 x 1 under the pressure 0.3 and the shear 0.1 on its top: every force is known. */
TEST(Equilibrium, OfABlockIsKnown)
{
  const Scene<2> scene = scene_of({given::box("2, 1", "3, 2"),
                                   given::rough("bottom", "bilateral", "0.02"),
                                   {"Boundary left/Displacement", "0; free"},
                                   {"Boundary top/Traction", "-0.1; -0.3"},
                                   {"Body force/Expression", "0; -0.05"},
                                   {"Adaptivity/Maximum steps", "3"}});
  last_step<2>(scene,
               [](const StepReport<2> &step)
               {
                 const Equilibrium<2> &e = step.equilibrium;
                 EXPECT_NEAR(e.loads.force[0], -0.2, 1e-14);
                 EXPECT_NEAR(e.loads.force[1], -0.7, 1e-14);
                 EXPECT_NEAR(e.loads.moment, 0.1,
                             1e-14); // the shear acts half a unit above the centre
                 ASSERT_EQ(e.reactions.size(), 2u);
                 const BoundaryForce<2> &wall = e.reactions[0], &floor = e.reactions[1];
                 EXPECT_EQ(wall.boundary, "left");
                 EXPECT_EQ(floor.boundary, "bottom");
                 EXPECT_NEAR(floor.force[0], step.contact.at(0).friction_resultant, 1e-12);
                 EXPECT_NEAR(wall.force[0] + floor.force[0], 0.2, 1e-12);
                 EXPECT_NEAR(wall.force[1], 0., 1e-12);
                 EXPECT_NEAR(floor.force[1], 0.7, 1e-12);
                 EXPECT_NEAR(wall.moment + floor.moment, -0.1, 1e-12);
                 EXPECT_LE(e.force_imbalance, 1e-13);
                 EXPECT_LE(e.moment_imbalance, 1e-13);
               });
}

/** Friction on two boundaries: each gets its own force, opposite tangents or not. */
TEST(Equilibrium, TellsTwoContactsApart)
{
  const Scene<2> scene = scene_of({given::box("3, 1", "3, 1"),
                                   given::rough("bottom", "bilateral", "0.01"),
                                   given::rough("top", "bilateral", "0.03"),
                                   {"Boundary right/Displacement", "0.2; free"},
                                   {"Adaptivity/Maximum steps", "3"}});
  last_step<2>(scene,
               [](const StepReport<2> &step)
               {
                 ASSERT_EQ(step.equilibrium.reactions.size(), 3u);
                 // everything slips to the right
                 EXPECT_NEAR(step.equilibrium.reactions[1].force[0], -0.03, 1e-12);
                 EXPECT_NEAR(step.equilibrium.reactions[2].force[0], -0.09, 1e-12);
                 EXPECT_NEAR(step.equilibrium.reactions[0].force[0], 0.12, 1e-12);
                 EXPECT_LE(step.equilibrium.force_imbalance, 1e-13);
               });
}

/** A solution that is none: forces that do not balance are seen. */
TEST(Equilibrium, SeesWhatDoesNotBalance)
{
  const Scene<2> scene = scene_of(slope());
  const RandomMesh mesh(scene, 7, 2);
  const Laboratory discrete(scene, mesh);
  Solution<2> solution = discrete.solve();
  EXPECT_LE(equilibrium(scene, nodal_forces(solution, discrete.system)).force_imbalance, 1e-13);
  EXPECT_LE(equilibrium(scene, nodal_forces(solution, discrete.system)).moment_imbalance, 1e-13);
  solution.u *= 1.01;
  EXPECT_GT(equilibrium(scene, nodal_forces(solution, discrete.system)).force_imbalance, 1e-4);
}
} // namespace
