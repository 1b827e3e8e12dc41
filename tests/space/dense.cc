// SPDX-License-Identifier: LGPL-2.1-or-later
// The same minimum by another way: a dense dual problem for the forces of friction, by projected gradients.
#include "runs.h"

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/trilinos_solver.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace space;

/** The unknowns of all contact dofs, one after the other, and what a force on them has to be. */
struct ContactForces
{
  std::vector<unsigned int> unknowns;
  std::vector<double> signs, gaps;
};

ContactForces contact_forces(const PrimalSpace<3> &space)
{
  ContactForces result;
  for (const ContactDof<3> &contact_dof : space.contact)
  {
    for (unsigned int s = 0; s < contact_dof.n_unknowns(); ++s)
    {
      result.unknowns.push_back(contact_dof.unknowns[s]);
      result.signs.push_back(contact_dof.sign);
      result.gaps.push_back(contact_dof.gap[s]);
    }
  }
  return result;
}

/** F := the nearest forces that the laws allow. */
void project(const PrimalSpace<3> &space, Vector<double> &F)
{
  unsigned int i = 0;
  for (const ContactDof<3> &contact_dof : space.contact)
  {
    if (contact_dof.is_friction())
    {
      const double norm = std::hypot(F[i], F[i + 1]);
      for (unsigned int s = 0; norm > contact_dof.weight && s < 2; ++s)
        F[i + s] *= contact_dof.weight / norm;
    }
    else
      F[i] = std::max(0., F[i]);
    i += contact_dof.n_unknowns();
  }
}

/** `1/2 F'SF - d'F` least, by projected gradients with Nesterov's momentum, anew where that leads uphill. */
Vector<double> minimiser(const PrimalSpace<3> &space, const LAPACKFullMatrix<double> &S,
                         const Vector<double> &d)
{
  const double length = 1. / S.linfty_norm();
  Vector<double> F(d.size()), ahead(F), r(F);
  double momentum = 1;
  for (unsigned int step = 0; step < 20000; ++step)
  {
    S.vmult(r, ahead);
    r -= d;
    Vector<double> next(ahead);
    next.add(-length, r);
    project(space, next);
    Vector<double> move(next);
    move -= F;
    if (move.l2_norm() <= 1e-12 * next.l2_norm())
      return next;
    momentum = r * move > 0 ? 1. : momentum;
    const double following = 0.5 * (1 + std::sqrt(1 + 4 * momentum * momentum));
    F = ahead = next;
    ahead.add((momentum - 1) / following, move);
    momentum = following;
  }
  ADD_FAILURE() << "no minimiser found";
  return F;
}

/**
 * J of the last mesh: with `S = P A^-1 P'`, P picking contact dofs, `max_F -1/2 (f - P'F)' A^-1 (f - P'F) - u_0'F` over
 * frictions in their discs and pressures that are not negative.
 */
double dual_minimum(const PrimalSpace<3> &space)
{
  PrimalSystem<3> system(space);
  SolverControl control;
  TrilinosWrappers::SolverDirect factor(control);
  factor.initialize(system.matrix());
  const ContactForces forces = contact_forces(space);
  const unsigned int n = forces.unknowns.size();
  LAPACKFullMatrix<double> S(n);
  Vector<double> d(n);
  DistributedVector b = system.f, x = system.f;
  factor.solve(x, b);
  const double loads = system.f * x;
  for (unsigned int i = 0; i < n; ++i)
    d[i] = forces.signs[i] * x.local_element(forces.unknowns[i]) - forces.gaps[i];
  for (unsigned int j = 0; j < n; ++j)
  {
    b = 0;
    b.local_element(forces.unknowns[j]) = forces.signs[j];
    factor.solve(x, b);
    for (unsigned int i = 0; i < n; ++i)
      S(i, j) = forces.signs[i] * x.local_element(forces.unknowns[i]);
  }
  const Vector<double> F = minimiser(space, S, d);
  Vector<double> SF(n);
  S.vmult(SF, F);
  return -0.5 * loads + d * F - 0.5 * (F * SF);
}

void expect_dual_minimum(const Scene<3> &scene)
{
  double dual = 0;
  const auto steps = steps_of<3>(scene,
                                 [&](const StepReport<3> &step)
                                 {
                                   if (!step.stopped_by.empty())
                                     dual = dual_minimum(step.primal->space);
                                   EXPECT_GT(step.primal->newton.n_slipping, 0);
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
  expect_dual_minimum(
      slab({given::steps("hap3", "1"), {"Boundary bottom/Friction bound", "6*max(0, x - 1 - z)"}}));
}

TEST(Dense, UnilateralContact)
{
  for (const char *const method : {"hap2", "hap3"})
    expect_dual_minimum(slab({given::steps(method, "1"),
                              {"Boundary bottom/Contact", "unilateral"},
                              {"Boundary bottom/Gap", "0.004*x*z"}}));
}
} // namespace
