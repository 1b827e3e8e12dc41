// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact that may open: pressures at the Gauss points of contact faces, on the primal path.
#include "reduced_path.h"

#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/space/transfer.h>

#include <algorithm>

namespace
{
using namespace space;

/** prm/slab.prm, free to leave the plane, which lies @p gap below it. */
Scene<3> lifted_slab(const Overrides &overrides = {}, const std::string &gap = "")
{
  Overrides all{{"Boundary bottom/Contact", "unilateral"},
                {"Boundary bottom/Gap", gap},
                {"Adaptivity/Maximum steps", "2"}};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return slab(all);
}

/** A block as high as 1 that its top moves down by @p shift, smooth walls on two sides, cells that are no cubes, hanging nodes. */
Scene<3> pressed_block(const unsigned int degree, const double shift, const double gap)
{
  Scene<3> scene;
  scene.materials[0].young = 7;
  scene.materials[0].poisson = 0.3;
  scene.geometry.corners = box_corners(Point<3>(0, 0, 0), Point<3>(2, 1, 3));
  scene.geometry.subdivisions = {{2, 1, 2}};
  scene.geometry.graded_towards = {Point<3>(2, 0, 0)};
  scene.geometry.grading_levels = 2;
  scene.adaptivity.start_degree = degree;
  scene.adaptivity.maximum_steps = 1;
  scene.solver.primal_tolerance = 1e-12;
  scene.boundary("left").contact = Contact::bilateral;
  scene.boundary("front").contact = Contact::bilateral;
  scene.boundary("top").displacement[1] = expression<3>(-shift);
  scene.boundary("bottom").contact = Contact::unilateral;
  scene.boundary("bottom").gap = expression<3>(gap);
  return scene;
}

/** Uniaxial stress: p = E (shift - gap)/height, or none. */
void expect_pressure(const Scene<3> &scene, const double expected)
{
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                for (const ContactState<3> &state : step.contact)
                  for (const ContactPoint<3> &point : state.points)
                  {
                    if (!scene.boundaries[state.boundary].is_unilateral())
                      continue;
                    EXPECT_NEAR(point.normal_traction, -expected, 1e-9);
                    EXPECT_EQ(point.mode(), expected > 0 ? ContactMode::slip : ContactMode::open);
                    if (expected > 0)
                    {
                      EXPECT_NEAR(point.gap, 0, 1e-12);
                    }
                    else
                    {
                      EXPECT_GT(point.gap, 1e-3);
                    }
                  }
                const double strain = expected / scene.materials[0].young;
                EXPECT_NEAR(step.energies.energy, 0.5 * expected * strain * 6, 1e-11);
                EXPECT_LT(step.norms.total, 1e-9);
                EXPECT_EQ(step.primal->newton.n_pressing,
                          expected > 0 ? step.primal->space.n_pressures : 0);
                for (const auto &force : step.equilibrium.reactions)
                  if (force.boundary == "bottom")
                  {
                    EXPECT_NEAR(force.force[1], 6 * expected, 1e-9);
                  }
              });
}

TEST(Unilateral, BlockPressedUniformly)
{
  for (const unsigned int degree : {2U, 3U, 4U})
    expect_pressure(pressed_block(degree, 0.05, 0.02), 7 * 0.03);
}

TEST(Unilateral, BlockThatDoesNotReachTheFoundation)
{
  expect_pressure(pressed_block(3, 0.01, 0.02), 0);
}

/** Interference alone: the load vector is zero. */
TEST(Unilateral, FoundationThatPushesTheBlockUp)
{
  expect_pressure(pressed_block(2, 0, -0.04), 7 * 0.04);
}

Scene<2> opening_plane(const Overrides &overrides)
{
  Overrides all{{"Solver/Normal contact", "multiplier"}, {"Adaptivity/Maximum steps", "4"}};
  all.insert(all.end(), overrides.begin(), overrides.end());
  Scene<2> scene = read_scene<2>("prm/han-6-12-unilateral.prm", all);
  scene.solver.primal_tolerance = 1e-12;
  return scene;
}

TEST(Unilateral, BothPathsAgreeInThePlane)
{
  for (const char *const method : {"hap2", "hap3", "hup4"})
    expect_reduced_path(opening_plane({{"Adaptivity/Method", method}}));
}

TEST(Unilateral, BothPathsAgreeOnACurvedFoundationWithoutFriction)
{
  expect_reduced_path(
      opening_plane({{"Adaptivity/Method", "hap3"},
                     {"Boundary bottom/Friction bound", ""},
                     {"Adaptivity/Maximum steps", "3"}, // then p4est refines one cell more
                     {"Boundary bottom/Gap", "0.002*(x - 4)*(x - 2)*exp(x/4) + 0.02*(4 - x)"}}));
}

/** Plane strain: a slab of one layer with u_z = 0 on both sides. */
TEST(Unilateral, SlabIsPlaneStrain)
{
  for (const char *const method : {"hup2", "hup3"})
  {
    const Scene<2> plane = opening_plane({given::steps(method, "2"), {"Material/Plane", "strain"}});
    const Scene<3> scene = lifted_slab({{"Adaptivity/Method", method},
                                        given::box("4, 4, 0.75", "4, 4, 1"),
                                        {"Boundary left/Traction", "1.5*(5 - y); -0.75; 0"},
                                        {"Boundary front/Displacement", "free; free; 0"},
                                        {"Boundary back/Displacement", "free; free; 0"}});
    std::vector<double> flat;
    AdaptiveSolver<2>(plane).run([&](const StepReport<2> &step)
                                 { flat.push_back(step.energies.lagrangian); });
    const auto thick = steps_of<3>(scene);
    for (unsigned int k = 0; k < flat.size(); ++k)
      EXPECT_NEAR(thick[k].lagrangian / 0.75, flat[k], 1e-9 * std::abs(flat[k]));
  }
}

TEST(Unilateral, TurnedSlabsAgree)
{
  expect_turned(lifted_slab({}, "0.003*x*z"), {{"Gap", "0.003*x*y"}, {"Friction bound", "4.5"}},
                1e-10);
}

/** p >= 0, m <= u_0 and p (m - u_0) = 0 at every point, some of which press and some not. */
void expect_complementarity(const StepReport<3> &step)
{
  const DistributedVector v = step.primal->space.in_contact_dofs(step.primal->u);
  ASSERT_EQ(step.contact.size(), 1u);
  const std::vector<ContactPoint<3>> &points = step.contact[0].points;
  unsigned int n_open = 0, n_pressing = 0;
  for (unsigned int k = 0; k < step.primal->space.contact.size(); ++k)
  {
    const ContactDof<3> &contact_dof = step.primal->space.contact[k];
    if (contact_dof.is_friction())
      continue;
    const auto point =
        std::find_if(points.begin(), points.end(),
                     [&](const auto &p) { return p.x.distance(contact_dof.x) < 1e-12; });
    ASSERT_NE(point, points.end());
    const double pressure = -point->normal_traction,
                 distance = contact_dof.gap[0] - step.primal->space.contact_value(v, k)[0];
    EXPECT_GE(pressure, 0);
    EXPECT_GE(distance, -1e-12);
    EXPECT_LE(pressure * distance, 1e-12);
    ++(pressure > 0 ? n_pressing : n_open);
    EXPECT_EQ(pressure == 0, point->mode() == ContactMode::open);
  }
  EXPECT_GT(n_open, 0);
  EXPECT_GT(n_pressing, 0);
  EXPECT_EQ(n_pressing, step.primal->newton.n_pressing);
  // A disc without pressure is open, not slipping.
  EXPECT_EQ(step.primal->newton.n_slipping,
            std::count_if(points.begin(), points.end(),
                          [](const auto &point) { return point.mode() == ContactMode::slip; }));
}

/** Of all forces by boundary, and that of the foundation by its pressures. */
void expect_balance(const StepReport<3> &step)
{
  EXPECT_LT(step.equilibrium.force_imbalance, 1e-9);
  EXPECT_LT(step.equilibrium.moment_imbalance, 1e-9);
  ASSERT_EQ(step.contact.size(), 1u);
  double press = 0;
  for (const ContactPoint<3> &point : step.contact[0].points)
    press -= point.area * point.normal_traction;
  EXPECT_NEAR(step.contact[0].normal_resultant, -press, 1e-12 * (1 + press));
  for (const auto &force : step.equilibrium.reactions)
    if (force.boundary == "bottom")
    {
      EXPECT_NEAR(force.force[1], press, 1e-9);
    }
}

TEST(Unilateral, ComplementarityAndBalance)
{
  for (const char *const method : {"hap2", "hap3", "hap4"})
    steps_of<3>(lifted_slab({{"Adaptivity/Method", method}, {"Geometry/Subdivisions", "2, 2, 1"}},
                            "0.05*x*z"),
                [](const StepReport<3> &step)
                {
                  expect_complementarity(step);
                  expect_balance(step);
                });
}

/** Cut off after one step the augmented Lagrangian ends where Newton's method does. */
TEST(Unilateral, AugmentedLagrangianAgrees)
{
  steps_of<3>(lifted_slab({}, "0.004*x*z"),
              [](const StepReport<3> &step)
              {
                PrimalSystem<3> system(step.primal->space);
                NewtonMatrix<3> matrix(step.primal->space, system);
                SemismoothNewton<3> newton(step.primal->space, system, matrix);
                DistributedVector v = step.primal->space.owned_vector();
                std::vector<ContactVector<3>> lambda;
                NewtonSettings settings;
                settings.residual = 1e-10;
                settings.maximum_steps = 1;
                const NewtonReport report = newton.solve(v, lambda, settings);
                EXPECT_TRUE(report.augmented_steps > 3);
                EXPECT_EQ(report.n_slipping, step.primal->newton.n_slipping);
                EXPECT_EQ(report.n_pressing, step.primal->newton.n_pressing);
                DistributedVector difference = step.primal->space.displacement(v);
                difference -= step.primal->u;
                EXPECT_LT(difference.l2_norm(), 1e-7 * step.primal->u.l2_norm());
              });
}

/** What degree p - 2 = 1 holds in each direction: a friction of two components, or a pressure. */
ContactVector<3> bilinear(const ContactDof<3> &contact_dof)
{
  const double a =
      contact_dof.x[0] - 0.5 * contact_dof.x[2] + 0.1 * contact_dof.x[0] * contact_dof.x[2];
  return contact_dof.is_friction() ? ContactVector<3>({a, 1 - a}) : ContactVector<3>({2 + a, 0.});
}

/** Children take the polynomials of their parent, pressures as well as frictions, from cells that persist and that do not. */
TEST(Unilateral, TransferKeepsPolynomials)
{
  const Scene<3> scene = lifted_slab({{"Adaptivity/Method", "hap3"}});
  const DegreeTables<3> tables(3);
  PrimalSpace<3>::Mesh mesh(MPI_COMM_SELF);
  make_mesh(scene, static_cast<Triangulation<3> &>(mesh));
  const PrimalSpace<3> coarse(scene, mesh, tables);
  std::vector<ContactVector<3>> lambda;
  for (const ContactDof<3> &contact_dof : coarse.contact)
    lambda.push_back(bilinear(contact_dof));
  mesh.begin_active()->set_refine_flag();
  mesh.last_active()->set_refine_flag();
  mesh.prepare_coarsening_and_refinement();
  DistributedVector u = coarse.ghosted_vector();
  Transfer<3> transfer(mesh, coarse, u, lambda);
  mesh.execute_coarsening_and_refinement();
  const PrimalSpace<3> fine(scene, mesh, tables);
  transfer.unpack(fine, u, lambda);
  ASSERT_EQ(lambda.size(), fine.contact.size());
  ASSERT_GT(fine.contact.size(), coarse.contact.size());
  for (unsigned int k = 0; k < lambda.size(); ++k)
    EXPECT_LT((lambda[k] - bilinear(fine.contact[k])).norm(), 1e-12);
}

/** Where no tolerance is named, what is left is small beside the indicator. */
TEST(Unilateral, StopsWhereTheEstimatedErrorSaysSo)
{
  Scene<3> scene = lifted_slab({{"Adaptivity/Maximum steps", "3"}}, "0.004*x*z");
  const auto exact = steps_of<3>(scene);
  scene.solver.primal_tolerance = 0;
  unsigned int k = 0;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                EXPECT_LE(step.primal->newton.error, 1e-2 * step.scaled_estimate);
                EXPECT_LE(std::abs(step.energies.lagrangian - exact[k].lagrangian),
                          std::pow(step.primal->newton.error, 2) + 1e-8);
                ++k;
              });
}
} // namespace
