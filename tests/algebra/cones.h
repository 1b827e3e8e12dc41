// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_algebra_cones_h
#define hpvi_algebra_cones_h

#include "programs.h"

#include <hpvi/solvers/coulomb_solver.h>

/** Problems of Coulomb friction, and what their solutions fulfil. */
namespace algebra
{
using hpvi::ConeProgram;
using hpvi::CoulombReport;
using hpvi::CoulombSolver;
using Method = CoulombSolver::Method;

/** k cones: components 0 to k-1 are tangential, k to 2k-1 normal, in half lines or free. */
inline ConeProgram program(LAPACKFullMatrix<double> S, Vector<double> d,
                           const hpvi::FrictionLimit &friction, const bool bilateral = false)
{
  const unsigned int k = d.size() / 2;
  ConeProgram result{std::move(S),
                     std::move(d),
                     {},
                     {FullMatrix<double>(), Vector<double>()},
                     FullMatrix<double>()};
  for (unsigned int i = 0; i < 2 * k; ++i)
    result.set.fixed.add_interval(i < k || bilateral ? -infinity : 0., infinity);
  for (unsigned int i = 0; i < k; ++i)
    result.set.cones.push_back({i, k + i, friction});
  return result;
}

/** Pressed on the whole, with S that couples everything with everything. */
inline ConeProgram random_cones(const unsigned int seed, const hpvi::FrictionLimit &friction,
                                const bool bilateral = false)
{
  std::mt19937 random(seed);
  const unsigned int k = 5 + random() % 25;
  ConeProgram result =
      program(random_matrix(2 * k, random), random_vector(2 * k, random), friction, bilateral);
  for (unsigned int i = k; i < 2 * k; ++i)
    result.d[i] += 0.5;
  return result;
}

inline ConeProgram random_cones(const unsigned int seed, const double mu,
                                const bool bilateral = false)
{
  return random_cones(seed, hpvi::FrictionLimit{0., mu}, bilateral);
}

/**
 * Flat contact of a half plane: the logarithmic kernel for both directions, and what couples them, the
 * kernel sign(x - y), with the factor @p coupling of Dundurs. Sheared towards one side.
 */
inline ConeProgram half_plane(const double mu, const double coupling, const double shear)
{
  const QuadraticProgram edge = edge_program(1.);
  const unsigned int k = edge.d.size();
  LAPACKFullMatrix<double> S(2 * k);
  Vector<double> d(2 * k);
  for (unsigned int i = 0; i < k; ++i)
    for (unsigned int j = 0; j < k; ++j)
      S(i, j) = S(k + i, k + j) = edge.S(i, j);
  for (unsigned int i = 0; i < k; ++i)
    for (unsigned int j = 0; j < k; ++j)
      S(k + i, j) = S(j, k + i) =
          coupling * std::sqrt(edge.S(i, i) * edge.S(j, j)) * ((i > j) - (i < j)) / k;
  for (unsigned int i = 0; i < k; ++i)
  {
    const double x = (i + 0.5) / k - 0.5;
    d[i] = shear * edge.S(i, i);
    d[k + i] = (1. - 5. * x * x) * edge.S(i, i);
  }
  return program(S, d, {0., mu});
}

inline CoulombReport solve(const ConeProgram &cones, Vector<double> &z, Vector<double> &alpha,
                           const Method method = Method::newton, const unsigned int first_rung = 0,
                           const bool warm = false)
{
  if (!warm)
  {
    z.reinit(cones.d.size());
    alpha.reinit(cones.balance.e.size());
  }
  return CoulombSolver(with_tolerance(1e-10), method, first_rung).solve(cones, z, alpha, warm);
}

/** The conditions of Coulomb's law and of contact, written out. */
inline void expect_solution(const ConeProgram &cones, const Vector<double> &z,
                            const Vector<double> &alpha)
{
  const unsigned int n = z.size();
  Vector<double> r(n);
  cones.S.vmult(r, z);
  r -= cones.d;
  if (alpha.size() > 0)
    r -= cones.balance.along(alpha);
  const double small = 1e-8 * (cones.d.linfty_norm() + 1e-30);
  std::vector<bool> is_tangential(n);
  for (const auto &[t, normal, friction] : cones.set.cones)
  {
    is_tangential[t] = true;
    const double bound = friction.limit(z[normal]);
    EXPECT_LE(std::abs(z[t]), bound);
    if (std::abs(z[t]) < bound)
    {
      EXPECT_NEAR(r[t], 0., small) << "stick " << t;
    }
    else
    {
      EXPECT_LE(r[t] * z[t], small * bound) << "slip " << t;
    }
  }
  QuadraticProgram fixed{cones.S, cones.d, cones.set.fixed};
  EXPECT_TRUE(is_feasible(fixed, z));
  Vector<double> phi, beta;
  cones.set.fixed.split_gradient(z, r, phi, beta);
  for (unsigned int i = 0; i < n; ++i)
    if (!is_tangential[i])
    {
      EXPECT_NEAR(phi[i] + beta[i], 0., small) << "component " << i;
    }
  if (alpha.size() > 0)
  {
    EXPECT_LE(cones.balance.gap(z).l2_norm(), 1e-8 * cones.balance.e.l2_norm());
  }
}
} // namespace algebra

#endif
