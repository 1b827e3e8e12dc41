// SPDX-License-Identifier: LGPL-2.1-or-later
// Multigrid without a matrix beside the assembled matrix and factorisations.
#include "runs.h"

#include <hpvi/space/multigrid.h>
#include <hpvi/space/semismooth_newton.h>

#include <deal.II/grid/grid_generator.h>

#include <random>

namespace
{
using namespace space;

Scene<3> dome(const char *const subdivisions = "4, 2, 4")
{
  Scene<3> scene = read_scene<3>("prm/dome.prm", {{"Geometry/Subdivisions", subdivisions},
                                                  {"Adaptivity/Maximum unknowns", "4000"}});
  scene.solver.primal_tolerance = 1e-11;
  return scene;
}

Scene<3> two_materials()
{
  return slab({{"Material hard/Where", "y - 2"},
               {"Material hard/Young's modulus", "1500"},
               {"Adaptivity/Maximum unknowns", "4000"}});
}

Scene<3> fibres_beside_another()
{
  return slab(fibres("1, 2, 0.5; 0, 1, 1", "Material hard") +
              Overrides{{"Material hard/Where", "y - 2"}, {"Adaptivity/Maximum unknowns", "4000"}});
}

Scene<3> slanted_dome()
{
  Scene<3> scene =
      read_scene<3>("prm/dome.prm", {{"Boundary bottom/Contact direction", "0.3; -1; 0.2"},
                                     {"Error/Bound", "false"},
                                     {"Adaptivity/Maximum unknowns", "4000"}});
  scene.solver.primal_tolerance = 1e-11;
  return scene;
}

/** Steps of a run by @p method, which must not break down. */
std::vector<Step> steps_by(Scene<3> scene, const LinearMethod method)
{
  scene.solver.linear = method;
  return steps_of<3>(scene,
                     [&](const StepReport<3> &step)
                     {
                       EXPECT_FALSE(step.primal->newton.fell_back);
                       EXPECT_EQ(step.primal->newton.linear, method);
                     });
}

void expect_same_steps(const Scene<3> &scene)
{
  const std::vector<Step> ours = steps_by(scene, LinearMethod::multigrid),
                          theirs = steps_by(scene, LinearMethod::direct);
  ASSERT_EQ(ours.size(), theirs.size());
  ASSERT_GT(ours.size(), 1);
  for (unsigned int k = 0; k < ours.size(); ++k)
  {
    EXPECT_EQ(ours[k].n_cells, theirs[k].n_cells);
    EXPECT_EQ(ours[k].n_slipping, theirs[k].n_slipping);
    EXPECT_EQ(ours[k].n_pressing, theirs[k].n_pressing);
    EXPECT_NEAR(ours[k].lagrangian, theirs[k].lagrangian, 1e-9 * std::abs(theirs[k].lagrangian));
  }
}

TEST(Multigrid, FindsWhatAFactorisationFinds)
{
  using Row = std::pair<const char *, const char *>;
  for (const auto &[degree, subdivisions] :
       {Row("2", "2, 2, 1"), Row("3", "2, 2, 1"), Row("4", "2, 2, 1"),
        Row("2", "5, 5, 2")}) // the last has too many unknowns to factorise
    expect_same_steps(slab({{"Geometry/Subdivisions", subdivisions},
                            {"Adaptivity/Start degree", degree},
                            {"Adaptivity/Maximum unknowns", "3000"}}));
}

TEST(Multigrid, KnowsPressuresAndMaterials)
{
  expect_same_steps(dome());
  expect_same_steps(dome("6, 2, 6"));
  expect_same_steps(two_materials());
  expect_same_steps(fibres_beside_another());
  expect_same_steps(slanted_dome());
}

/** Calls @p look with the space of the last mesh, which has hanging nodes. */
void on_last_mesh(const Scene<3> &scene, const std::function<void(const PrimalSpace<3> &)> &look)
{
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                if (!step.stopped_by.empty())
                  look(step.primal->space);
              });
}

template <typename Vector>
void randomise(Vector &v, std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
    v.local_element(i) = uniform(random);
}

TEST(Multigrid, HasProductsAndBlocksOfTheMatrix)
{
  std::mt19937 random;
  for (const Scene<3> &scene : {dome(), two_materials(), fibres_beside_another(), slanted_dome()})
    on_last_mesh(scene,
                 [&](const PrimalSpace<3> &space)
                 {
                   EXPECT_TRUE(space.dof_handler.get_triangulation().has_hanging_nodes());
                   PrimalSystem<3> system(space);
                   NewtonMatrix<3> assembled(space, system, LinearMethod::amg);
                   NewtonMatrix<3> free(space, system, LinearMethod::multigrid);
                   DistributedVector x = space.owned_vector(), y = x, z = x;
                   randomise(x, random);
                   space.constraints.set_zero(x);
                   assembled.multiply(y, x);
                   free.multiply(z, x);
                   z -= y;
                   space.constraints.set_zero(z);
                   EXPECT_LT(z.l2_norm(), 1e-12 * y.l2_norm());
                   for (unsigned int k = 0; k < space.contact.size(); ++k)
                     EXPECT_LT((assembled.block(k) - free.block(k)).norm(),
                               1e-12 * assembled.block(k).norm());
                 });
}

/** A V-cycle is symmetric, to the digits of single precision, with states of all kinds, above a factorisation and above ML. */
TEST(Multigrid, PreconditionsBySymmetricOperators)
{
  std::mt19937 random;
  for (const char *const subdivisions : {"4, 2, 4", "6, 2, 6"})
    on_last_mesh(dome(subdivisions),
                 [&](const PrimalSpace<3> &space)
                 {
                   Multigrid multigrid(space);
                   std::vector<ContactDofState<3>> states(space.contact.size());
                   for (ContactDofState<3> &state : states)
                     if (random() % 2)
                       state.is_held = true;
                     else if (random() % 2)
                       state.stiffness = 10. * unit_symmetric_tensor<2>();
                   multigrid.linearise(states);
                   DistributedVector x = space.owned_vector(), y = x, Px = x, Py = x, r = x;
                   randomise(x, random);
                   randomise(y, random);
                   multigrid.finest.mask(x);
                   multigrid.finest.mask(y);
                   multigrid.precondition(Px, x);
                   multigrid.precondition(Py, y);
                   EXPECT_NEAR(Px * y, Py * x, 1e-5 * std::sqrt((Px * x) * (Py * y)));
                   EXPECT_GT(Px * x, 0);
                   // and near to the inverse
                   multigrid.multiply_linearised(r, Px);
                   r -= x;
                   multigrid.precondition(Py, r);
                   EXPECT_LT(Py * r, 0.1 * (Px * x));
                 });
}

/** Conjugate gradients may stop by the error in the energy norm, which the preconditioner knows, in a part of the steps. */
TEST(Multigrid, StopsWhereTheErrorIsSmall)
{
  std::mt19937 random;
  on_last_mesh(two_materials(),
               [&](const PrimalSpace<3> &space)
               {
                 PrimalSystem<3> system(space);
                 NewtonMatrix<3> matrix(space, system, LinearMethod::multigrid);
                 matrix.linearise(std::vector<ContactDofState<3>>(space.contact.size()));
                 DistributedVector b = space.owned_vector(), exact = b, v = b, Ae = b;
                 randomise(b, random);
                 space.constraints.set_zero(b);
                 matrix.solve(exact, b, 1e-9 * b.l2_norm());
                 const unsigned int all_steps = matrix.n_steps;
                 const double wanted = 1e-3 * std::sqrt(b * exact);
                 matrix.solve(v, b, 1e-9 * b.l2_norm(), wanted);
                 EXPECT_LT(2 * (matrix.n_steps - all_steps), all_steps);
                 v -= exact;
                 matrix.multiply(Ae, v);
                 EXPECT_LT(std::sqrt(v * Ae), 1.5 * wanted);
               });
}

/** Steps of conjugate gradients do not grow with the mesh. */
TEST(Multigrid, TakesAFewStepsOnAnyMesh)
{
  Scene<3> scene = read_scene<3>("prm/slab.prm", {{"Adaptivity/Maximum unknowns", "20000"}});
  scene.solver.linear = LinearMethod::multigrid;
  scene.solver.primal_tolerance = 1e-6;
  unsigned int n = 0;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                EXPECT_LT(step.primal->newton.cg_steps, 30);
                n = step.primal->newton.cg_steps;
              });
  EXPECT_GT(n, 5);
}

TEST(Multigrid, LeavesHighDegreesToTheOther)
{
  const Scene<3> scene = slab();
  PrimalSpace<3>::Mesh mesh(MPI_COMM_SELF);
  GridGenerator::subdivided_hyper_rectangle(mesh, {1, 1, 1}, Point<3>(), Point<3>(4, 4, 2), true);
  const DegreeTables<3> low(4), high(5);
  EXPECT_EQ(linear_method(PrimalSpace<3>(scene, mesh, low)), LinearMethod::multigrid);
  EXPECT_EQ(linear_method(PrimalSpace<3>(scene, mesh, high)), LinearMethod::amg);
}
} // namespace
