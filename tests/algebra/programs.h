// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_algebra_programs_h
#define hpvi_algebra_programs_h

#include <deal.II/lac/full_matrix.h>
#include <gtest/gtest.h>
#include <hpvi/solvers/mprgp.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

/** Quadratic programs with known minimisers, for every solver. */
namespace algebra
{
using namespace dealii;
using hpvi::FeasibleSet;
using hpvi::infinity;
using hpvi::Mprgp;
using hpvi::QpReport;
using hpvi::QuadraticProgram;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

inline Vector<double> vec(const std::initializer_list<double> &components)
{
  return Vector<double>(components.begin(), components.end());
}

inline Mprgp::Settings with_tolerance(const double tolerance)
{
  Mprgp::Settings settings;
  settings.tolerance = tolerance;
  return settings;
}

/** `q(z) = 1/2 z'Sz - d'z` */
inline double value(const QuadraticProgram &qp, const Vector<double> &z)
{
  Vector<double> Sz(z.size());
  qp.S.vmult(Sz, z);
  return 0.5 * (Sz * z) - qp.d * z;
}

/** `|nu(z)|`, from scratch and in the variables as given. */
inline double projected_gradient(const QuadraticProgram &qp, const Vector<double> &z)
{
  Vector<double> r(z.size()), phi, beta;
  qp.S.vmult(r, z);
  r -= qp.d;
  qp.feasible_set.split_gradient(z, r, phi, beta);
  return std::hypot(phi.l2_norm(), beta.l2_norm());
}

inline bool is_feasible(const QuadraticProgram &qp, const Vector<double> &z)
{
  Vector<double> projected = z;
  qp.feasible_set.project(projected);
  return projected == z;
}

/** The same sides for all n components. */
inline FeasibleSet box(const unsigned int n, const double lower, const double upper)
{
  const std::vector<double> l(n, lower), u(n, upper);
  return FeasibleSet(Vector<double>(l.begin(), l.end()), Vector<double>(u.begin(), u.end()));
}

inline FeasibleSet unit_box(const unsigned int n)
{
  return box(n, -1., 1.);
}

inline Vector<double> random_vector(const unsigned int n, std::mt19937 &random)
{
  std::normal_distribution<double> normal;
  Vector<double> x(n);
  for (double &x_i : x)
    x_i = normal(random);
  return x;
}

/** `G G' / n + 0.05 I` with normally distributed G: condition around 100. */
inline LAPACKFullMatrix<double> random_matrix(const unsigned int n, std::mt19937 &random)
{
  std::normal_distribution<double> normal;
  LAPACKFullMatrix<double> G(n), S(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      G(i, j) = normal(random);
  G.mTmult(S, G);
  S /= n;
  for (unsigned int i = 0; i < n; ++i)
    S(i, i) += 0.05;
  return S;
}

/** Each side is missing in one of four cases, and one component in ten is fixed. */
inline FeasibleSet random_box(const unsigned int n, std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(0., 1.);
  Vector<double> lower(n), upper(n);
  for (unsigned int i = 0; i < n; ++i)
  {
    const double centre = uniform(random) - 0.5;
    const double radius = uniform(random) < 0.1 ? 0. : uniform(random);
    lower[i] = uniform(random) < 0.25 ? -infinity : centre - radius;
    upper[i] = uniform(random) < 0.25 ? infinity : centre + radius;
  }
  return FeasibleSet(lower, upper);
}

inline QuadraticProgram random_program(const unsigned int n, std::mt19937 &random)
{
  return {random_matrix(n, random), random_vector(n, random), random_box(n, random)};
}

/** Solve S_FF z_F = d_F - S_FA z_A for the free components by elimination. */
inline void minimise_on_face(const QuadraticProgram &qp, const std::vector<unsigned int> &free,
                             Vector<double> &z)
{
  const unsigned int m = free.size();
  for (const unsigned int i : free)
    z[i] = 0.;
  Vector<double> Sz(z.size());
  qp.S.vmult(Sz, z);
  std::vector<std::vector<double>> a(m, std::vector<double>(m + 1));
  for (unsigned int i = 0; i < m; ++i)
  {
    for (unsigned int j = 0; j < m; ++j)
      a[i][j] = qp.S(free[i], free[j]);
    a[i][m] = qp.d[free[i]] - Sz[free[i]];
  }
  for (unsigned int k = 0; k < m; ++k) // positive definite: no pivoting
    for (unsigned int i = k + 1; i < m; ++i)
      for (unsigned int j = m + 1; j-- > k;)
        a[i][j] -= a[i][k] / a[k][k] * a[k][j];
  for (unsigned int i = m; i-- > 0;)
  {
    for (unsigned int j = i + 1; j < m; ++j)
      a[i][m] -= a[i][j] * z[free[j]];
    z[free[i]] = a[i][m] / a[i][i];
  }
}

/**
 * The minimiser by brute force: it is the feasible one of least value among the minima on the
 * 3^n faces (each component free, at its lower, at its upper side).
 */
inline Vector<double> minimiser_by_enumeration(const QuadraticProgram &qp)
{
  const unsigned int n = qp.d.size();
  Vector<double> lower(n), upper(n); // the nearest points to infinity
  lower = -infinity;
  upper = infinity;
  qp.feasible_set.project(lower);
  qp.feasible_set.project(upper);
  Vector<double> best;
  double best_value = infinity;
  for (unsigned int face = 0; face < std::pow(3, n); ++face)
  {
    Vector<double> z(n);
    std::vector<unsigned int> free;
    bool exists = true;
    for (unsigned int i = 0, code = face; i < n; ++i, code /= 3)
      if (code % 3 == 0)
        free.push_back(i);
      else
      {
        z[i] = code % 3 == 1 ? lower[i] : upper[i];
        exists = exists && std::isfinite(z[i]);
      }
    if (!exists)
      continue;
    minimise_on_face(qp, free, z);
    for (unsigned int i = 0; i < n; ++i)
      exists = exists && z[i] >= lower[i] - 1e-12 && z[i] <= upper[i] + 1e-12;
    if (exists && value(qp, z) < best_value)
    {
      best = z;
      best_value = value(qp, z);
    }
  }
  return best;
}

inline void expect_near(const Vector<double> &a, const Vector<double> &b, const double tolerance)
{
  ASSERT_EQ(a.size(), b.size());
  for (unsigned int i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

/**
 * The operator of a contact edge behaves like the logarithmic kernel: constants on the cells of a
 * mesh that is graded towards the middle, `S_ij = int_i int_j -ln|x-y|`, from the second
 * antiderivative of the kernel.
 */
inline QuadraticProgram edge_program(const double load)
{
  std::vector<double> x = {0.};
  for (int level = 0; level < 8; ++level)
    for (int part = 1; part <= 6; ++part)
      x.push_back(0.5 - std::pow(2., -1 - level) * (1. - part / 12.));
  for (unsigned int i = x.size(); i-- > 0;)
    x.push_back(1. - x[i]);
  const auto g = [](const double t)
  { return t == 0. ? 0. : t * t * (0.75 - 0.5 * std::log(std::abs(t))); };

  const unsigned int n = x.size() - 1;
  QuadraticProgram qp{LAPACKFullMatrix<double>(n), Vector<double>(n), unit_box(n)};
  for (unsigned int i = 0; i < n; ++i)
  {
    for (unsigned int j = 0; j < n; ++j)
      qp.S(i, j) =
          g(x[i + 1] - x[j]) - g(x[i] - x[j]) - g(x[i + 1] - x[j + 1]) + g(x[i] - x[j + 1]);
    qp.d[i] = load * (x[i + 1] - x[i]) * std::cos(2. * (x[i] + x[i + 1]));
  }
  return qp;
}
} // namespace algebra

#endif
