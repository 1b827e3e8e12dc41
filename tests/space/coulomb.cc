// SPDX-License-Identifier: LGPL-2.1-or-later
// Friction that follows the pressure, on the primal path: as the reduced path has it in the plane, and in space.
#include "reduced_path.h"

#include <hpvi/base/numerical_failure.h>

#include <algorithm>

namespace
{
using namespace space;

/** Laws that know the pressure, each on a contact that has one. */
const std::vector<Overrides> laws{{given::coulomb("0.6")},
                                  {{"Boundary bottom/Friction bound", "0.4"},
                                   {"Boundary bottom/Friction coefficient", "0.2 + 0.1*x"},
                                   {"Boundary bottom/Friction law", "limited"}},
                                  {{"Boundary bottom/Friction bound", "0.2"},
                                   {"Boundary bottom/Friction coefficient", "0.3"},
                                   {"Boundary bottom/Friction law", "cohesive"}}};

Scene<2> plane(const Overrides &overrides)
{
  Scene<2> scene = read_scene<2>(
      "prm/han-6-12-unilateral.prm",
      with({{"Solver/Normal contact", "multiplier"}, given::steps("hap3", "3")}, overrides));
  scene.solver.primal_tolerance = 1e-12;
  return scene;
}

TEST(Coulomb, BothPathsAgreeInThePlane)
{
  for (const Overrides &law : laws) // the reduced path bisects edges with a kink of the limit, too
    for (const char *const contact : {"unilateral", "bilateral"})
      expect_reduced_path(
          plane(with(law, {{"Boundary bottom/Contact", contact}, given::steps("hup3", "2")})));
  for (const char *const method : {"hap2", "hap3", "hap4"})
    expect_reduced_path(plane(with(laws[0], {{"Adaptivity/Method", method}})));
}

/** prm/slab.prm under a law, as thick as one layer or in full. */
Scene<3> rubbing_slab(const Overrides &overrides)
{
  return slab(with({{"Boundary bottom/Contact", "unilateral"}, {"Adaptivity/Maximum steps", "2"}},
                   overrides));
}

/** Plane strain: a slab of one layer with u_z = 0 on both sides has its energy, and at first its indicator. */
TEST(Coulomb, SlabIsPlaneStrain)
{
  for (const Overrides &law : laws)
    for (const char *const contact : {"unilateral", "bilateral"})
    {
      const Overrides both = with(
          law, {{"Boundary bottom/Contact", contact},
                given::steps(&law == &laws[0] ? "hup3" : "hup2", &law == &laws[0] ? "1" : "2")});
      std::vector<std::array<double, 3>> flat;
      AdaptiveSolver<2>(plane(with(both, {{"Material/Plane", "strain"}})))
          .run(
              [&](const StepReport<2> &step) {
                flat.push_back(
                    {{step.energies.lagrangian, step.energies.energy, step.norms.total}});
              });
      const auto thick =
          steps_of<3>(rubbing_slab(with(both, {given::box("4, 4, 0.75", "4, 4, 1"),
                                               {"Boundary left/Traction", "1.5*(5 - y); -0.75; 0"},
                                               {"Boundary front/Displacement", "free; free; 0"},
                                               {"Boundary back/Displacement", "free; free; 0"}})));
      ASSERT_EQ(thick.size(), flat.size());
      for (unsigned int k = 0; k < flat.size(); ++k)
      {
        EXPECT_NEAR(thick[k].lagrangian / 0.75, flat[k][0], 1e-8 * std::abs(flat[k][0]));
        EXPECT_NEAR(thick[k].energy / 0.75, flat[k][1], 1e-6 * std::abs(flat[k][1]));
      }
      EXPECT_NEAR(thick[0].estimate / std::sqrt(0.75), flat[0][2], 1e-6 * flat[0][2]);
    }
}

TEST(Coulomb, TurnedSlabsAgree)
{
  expect_turned(rubbing_slab({given::coulomb("0.4 + 0.1*z")}),
                {{"Friction coefficient", "0.4 + 0.1*y"}}, 1e-9);
}

/**
 * `u = s + (a y, -e y, b y)`: pressed uniformly by p = E e, nu = 0, it slips along s everywhere, with the friction
 * `mu_f p` against it.
 */
KnownField<3> oblique_slip(const double young, const double pressure, const double coefficient,
                           const Tensor<1, 3> &slip)
{
  Tensor<1, 3> slope = 2 * coefficient * pressure / young * slip / slip.norm(); // G = E/2
  slope[1] = -pressure / young;
  Tensor<2, 3> gradient;
  for (unsigned int c = 0; c < 3; ++c)
    gradient[c][1] = slope[c];
  return {[=](const Point<3> &x) { return slip + x[1] * slope; },
          [=](const Point<3> &) { return gradient; }};
}

TEST(Coulomb, ObliqueSlipIsExact)
{
  for (const unsigned int degree : {2U, 3U, 4U})
    for (const Contact contact : {Contact::unilateral, Contact::bilateral})
    {
      Scene<3> scene;
      scene.materials[0].young = 7;
      scene.materials[0].poisson = 0;
      scene.geometry.corners = box_corners(Point<3>(0, 0, 0), Point<3>(2, 1, 3));
      scene.geometry.subdivisions = {{2, 1, 2}};
      scene.geometry.graded_towards = {Point<3>(2, 0, 0)};
      scene.geometry.grading_levels = degree == 4 ? 1 : 2;
      scene.adaptivity.start_degree = degree;
      scene.adaptivity.maximum_steps = 1;
      scene.solver.primal_tolerance = 1e-12;
      scene.boundary("bottom").contact = contact;
      scene.boundary("bottom").friction.coefficient = expression<3>(0.4);
      const KnownField<3> exact = oblique_slip(7, 0.3, 0.4, Tensor<1, 3>({0.03, 0, -0.05}));
      for (const char *const side : {"left", "right", "front", "back", "top"})
        prescribe(scene.boundary(side), exact);
      steps_of<3>(scene,
                  [&](const StepReport<3> &step)
                  {
                    EXPECT_LT(energy_error(step, exact), 1e-10);
                    EXPECT_LT(step.norms.total, 1e-9);
                    EXPECT_EQ(step.primal->newton.n_slipping, step.primal->space.n_discs);
                    EXPECT_GE(step.primal->newton.tresca_problems, 2u);
                    for (const ContactPoint<3> &point : step.contact.at(0).points)
                    {
                      EXPECT_EQ(point.mode(), ContactMode::slip);
                      EXPECT_NEAR(point.friction_bound, 0.4 * 0.3, 1e-10);
                    }
                  });
    }
}

/** At each Gauss point; forces are in balance with this friction. */
TEST(Coulomb, TheLawHoldsAtPoints)
{
  for (const char *const method : {"hap2", "hap3"})
    steps_of<3>(rubbing_slab({{"Adaptivity/Method", method},
                              {"Geometry/Subdivisions", "2, 2, 1"},
                              given::coulomb("0.6")}),
                [](const StepReport<3> &step)
                {
                  EXPECT_LT(step.equilibrium.force_imbalance, 1e-9);
                  EXPECT_LT(step.equilibrium.moment_imbalance, 1e-9);
                  unsigned int n_slipping = 0, n_sticking = 0;
                  for (const ContactPoint<3> &point : step.contact.at(0).points)
                  {
                    const double bound = 0.6 * std::max(0., -point.normal_traction),
                                 size = size_of(point.tangential_traction);
                    EXPECT_NEAR(point.friction_bound, bound, 1e-14);
                    EXPECT_LE(size, bound + 1e-12);
                    if (point.mode() == ContactMode::slip)
                    {
                      // contact dofs slip; the displacement at the point does so nearly
                      EXPECT_NEAR(size, bound, 1e-8 * bound);
                      EXPECT_LT(point.tangential_traction * point.slip, 0);
                      ++n_slipping;
                    }
                    n_sticking += point.mode() == ContactMode::stick;
                  }
                  EXPECT_GT(n_slipping + n_sticking, 0u);
                  EXPECT_EQ(step.primal->newton.n_slipping, n_slipping);
                });
}

/** A law that does not let go: the run ends with what to try. */
TEST(Coulomb, WithoutAFixedPointItFails)
{
  const Scene<3> scene = rubbing_slab({given::coulomb("50"),
                                       {"Boundary left/Traction", "1.5*(5 - y); -7; 0.5"},
                                       {"Adaptivity/Maximum steps", "1"}});
  const std::string failure = ::failure_of<NumericalFailure>([&] { steps_of<3>(scene); });
  EXPECT_TRUE(says(failure, "lower Friction coefficient")) << failure;
}

/** So nobody asks for it at each point where friction acts. */
TEST(Coulomb, ANumberIsKnownForOne)
{
  const auto is_number = [](const std::string &coefficient)
  {
    return is_constant<3>(
        rubbing_slab({given::coulomb(coefficient)}).boundary("bottom").friction.coefficient);
  };
  EXPECT_TRUE(is_number("0.5"));
  EXPECT_FALSE(is_number("0.5 + 0*x"));
}

/** Where no tolerance is named, what the fixed point leaves is small beside the indicator. */
TEST(Coulomb, StopsWhereTheEstimatedErrorSaysSo)
{
  Scene<3> scene = rubbing_slab(with(laws[0], {{"Geometry/Subdivisions", "2, 2, 1"}}));
  const auto exact = steps_of<3>(scene);
  scene.solver.primal_tolerance = 0;
  unsigned int k = 0;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                EXPECT_GT(step.primal->newton.error,
                          0); // no problem of Tresca needs it, their law does
                EXPECT_LE(step.primal->newton.error, 1e-2 * step.scaled_estimate);
                EXPECT_NEAR(step.energies.norm, exact[k].norm, step.primal->newton.error + 1e-8);
                ++k;
              });
}
} // namespace
