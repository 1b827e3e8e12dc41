// SPDX-License-Identifier: LGPL-2.1-or-later
// The same minimum by another way: a dense dual problem for the forces of friction, by projected gradients.
#include "runs.h"

#include <hpvi/solver/mprgp.h>

#include <deal.II/lac/trilinos_solver.h>

namespace
{
using namespace space;

/** J of the last mesh: with `S = P A^-1 P'`, P picking moments, `max_F -1/2 (f - P'F)' A^-1 (f - P'F)`. */
double dual_minimum(const MomentSpace<3> &space)
{
  const PrimalSystem<3> system(space);
  SolverControl control;
  TrilinosWrappers::SolverDirect factor(control);
  factor.initialize(system.A);
  const unsigned int n = 2 * space.discs.size();
  const auto unknown = [&](const unsigned int i) { return space.discs[i / 2].unknowns[i % 2]; };
  QuadraticProgram qp{LAPACKFullMatrix<double>(n), Vector<double>(n), FeasibleSet()};
  DistributedVector b = system.f, x = system.f;
  factor.solve(x, b);
  const double loads = system.f * x;
  for (unsigned int i = 0; i < n; ++i)
    qp.d[i] = x.local_element(unknown(i));
  for (unsigned int j = 0; j < n; ++j)
  {
    b = 0;
    b.local_element(unknown(j)) = 1;
    factor.solve(x, b);
    for (unsigned int i = 0; i < n; ++i)
      qp.S(i, j) = x.local_element(unknown(i));
    if (j % 2 == 0)
      qp.feasible_set.add_disc(space.discs[j / 2].radius);
  }
  Vector<double> F(n), SF(n);
  Mprgp::Settings settings;
  settings.tolerance = 1e-12;
  settings.diagonal_scaling = false; // it would make ellipses of discs
  Mprgp(settings).solve(qp, F);
  qp.S.vmult(SF, F);
  return -0.5 * loads + qp.d * F - 0.5 * (F * SF);
}

void expect_dual_minimum(const Scene<3> &scene)
{
  double dual = 0;
  const auto steps = steps_of<3>(scene,
                                 [&](const PrimalReport<3> &step)
                                 {
                                   if (!step.stopped_by.empty())
                                     dual = dual_minimum(step.space);
                                   EXPECT_GT(step.newton.n_slipping, 0);
                                 });
  EXPECT_NEAR(steps.back().lagrangian, dual, 1e-9 * std::abs(dual));
  EXPECT_LT(steps.back().n_slipping, steps.back().n_contact_points); // stick and slip
}

TEST(Dense, Uniform)
{
  expect_dual_minimum(
      slab({{"Adaptivity/Maximum steps", "1"}, {"Geometry/Subdivisions", "5, 5, 3"}}));
}

TEST(Dense, Adaptive)
{
  expect_dual_minimum(slab({{"Adaptivity/Maximum steps", "2"}}));
}

TEST(Dense, DegreeThreeWithABoundThatVanishes)
{
  expect_dual_minimum(slab({{"Adaptivity/Maximum steps", "1"},
                            {"Adaptivity/Method", "hap3"},
                            {"Boundary bottom/Friction bound", "6*max(0, x - 1 - z)"}}));
}
} // namespace
