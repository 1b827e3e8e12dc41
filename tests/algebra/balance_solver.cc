// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs.h"

#include <hpvi/solvers/active_set.h>
#include <hpvi/solvers/balance_solver.h>

#include <algorithm>

namespace
{
using namespace algebra;
using hpvi::ActiveSet;
using hpvi::BalanceSolver;
using hpvi::EqualityConstraints;
using hpvi::find_imbalance;

constexpr double tolerance = 1e-10;

struct Problem
{
  QuadraticProgram qp;
  EqualityConstraints balance;
  FullMatrix<double> penalty;
};

/** `S += G Gamma G'`, `d += G Gamma e`, with @p strength of tr(S) in each column and off the diagonal. */
void add_penalty(Problem &problem, const double strength)
{
  const FullMatrix<double> &G = problem.balance.G;
  const unsigned int n = G.m(), m = G.n();
  double trace = 0;
  for (unsigned int i = 0; i < n; ++i)
    trace += problem.qp.S(i, i);
  Vector<double> length(m);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < m; ++j)
      length[j] = std::hypot(length[j], G(i, j));
  problem.penalty.reinit(m, m);
  for (unsigned int j = 0; j < m; ++j)
    for (unsigned int k = 0; k < m; ++k)
      problem.penalty(j, k) = strength * trace / length[j] / length[k] * (j == k ? 1. : 0.3);
  FullMatrix<double> product(n, m);
  G.mmult(product, problem.penalty);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < m; ++j)
        problem.qp.S(i, k) += product(i, j) * G(k, j);
  problem.qp.d += [&]
  {
    Vector<double> forces(n);
    product.vmult(forces, problem.balance.e);
    return forces;
  }();
}

/** Intervals and half lines in turn, most of a feasible z on walls; columns of G in different units. */
Problem random_problem(const unsigned int n, const unsigned int m, const double strength,
                       std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(0., 1.);
  Problem problem{{random_matrix(n, random), random_vector(n, random), {}},
                  {FullMatrix<double>(), Vector<double>()},
                  FullMatrix<double>()};
  Vector<double> z(n);
  for (unsigned int i = 0; i < n; ++i)
    if (i % 2 == 0)
    {
      const double g = uniform(random);
      problem.qp.feasible_set.add_interval(-g, g);
      z[i] = uniform(random) < 0.7 ? g : g * (2. * uniform(random) - 1.);
    }
    else
    {
      problem.qp.feasible_set.add_interval(0., infinity);
      z[i] = uniform(random) < 0.6 ? 0. : 2. * uniform(random);
    }
  problem.balance.G.reinit(n, m);
  for (unsigned int j = 0; j < m; ++j)
  {
    const Vector<double> column = random_vector(n, random);
    for (unsigned int i = 0; i < n; ++i)
      problem.balance.G(i, j) = std::pow(100., j) * column[i];
  }
  problem.balance.e.reinit(m);
  problem.balance.G.Tvmult(problem.balance.e, z);
  add_penalty(problem, strength);
  return problem;
}

/** A block that rests on points of a plane under a weight at @p x, pushed by @p shear. */
Problem block(const std::vector<double> &points, const double shear, const double x,
              const double friction, const double clearance)
{
  const unsigned int k = points.size();
  Problem problem{{LAPACKFullMatrix<double>(2 * k), Vector<double>(2 * k), {}},
                  {FullMatrix<double>(2 * k, 3), vec({shear, 1., x})},
                  FullMatrix<double>()};
  for (unsigned int i = 0; i < 2 * k; ++i)
  {
    problem.qp.S(i, i) = 1.;
    if (i < k)
    {
      problem.qp.feasible_set.add_interval(-friction, friction);
      problem.balance.G(i, 0) = 1.;
      continue;
    }
    problem.qp.feasible_set.add_interval(0., infinity);
    problem.qp.d[i] = -clearance;
    problem.balance.G(i, 1) = 1.;
    problem.balance.G(i, 2) = points[i - k];
  }
  add_penalty(problem, 1.);
  return problem;
}

QpReport solve(const Problem &problem, Vector<double> &z, Vector<double> &alpha)
{
  const ActiveSet inner(with_tolerance(1e-12));
  return BalanceSolver([&](const QuadraticProgram &qp, Vector<double> &y)
                       { return inner.solve(qp, y); },
                       problem.penalty, tolerance)
      .solve(problem.qp, problem.balance, z, alpha);
}

void expect_solution(const Problem &problem, const Vector<double> &z, const Vector<double> &alpha,
                     const double kkt_tolerance)
{
  QuadraticProgram qp = problem.qp;
  EXPECT_TRUE(is_feasible(qp, z));
  qp.d += problem.balance.along(alpha);
  EXPECT_LE(projected_gradient(qp, z), kkt_tolerance * qp.d.l2_norm());
  const Vector<double> gap = problem.balance.gap(z);
  for (unsigned int j = 0; j < gap.size(); ++j)
  {
    double forces = 1e-14 + std::abs(problem.balance.e[j]);
    for (unsigned int i = 0; i < z.size(); ++i)
      forces += std::abs(problem.balance.G(i, j) * z[i]);
    EXPECT_LE(std::abs(gap[j]), tolerance * forces) << "equation " << j;
  }
}

/** Solutions by their conditions, and few factorisations. */
TEST(BalanceSolver, SolvesRandomProblems)
{
  for (unsigned int m = 1; m <= 3; ++m)
    for (const double strength : {0.1, 100.})
    {
      std::vector<unsigned int> solves;
      for (unsigned int seed = 0; seed < 20; ++seed)
      {
        SCOPED_TRACE("m = " + std::to_string(m) + ", seed " + std::to_string(seed));
        std::mt19937 random(seed);
        const Problem problem = random_problem(20 + 2 * seed, m, strength, random);
        Vector<double> z = random_vector(problem.qp.d.size(), random), alpha(m);
        const QpReport report = solve(problem, z, alpha);
        EXPECT_TRUE(report.converged);
        expect_solution(problem, z, alpha, 1e-11);
        solves.push_back(report.dense_solves);
      }
      std::nth_element(solves.begin(), solves.begin() + 10, solves.end());
      EXPECT_LE(solves[10], 9u);
    }
}

/** Two pressures that the balance alone decides; friction shares the push evenly. */
TEST(BalanceSolver, BlockOnTwoPoints)
{
  for (const double clearance : {0., 1000.}) // with it all points are open at the start
    for (const double x : {0., 0.5, 1.})     // at an end one point carries all, the other grazes
    {
      const Problem problem = block({-1., 1.}, 0.3, x, 0.2, clearance);
      EXPECT_FALSE(find_imbalance(problem.qp.feasible_set, problem.balance));
      Vector<double> z(4), alpha(3);
      EXPECT_TRUE(solve(problem, z, alpha).converged);
      expect_near(z, vec({0.15, 0.15, 0.5 * (1. - x), 0.5 * (1. + x)}), 1e-9);
      expect_solution(problem, z, alpha, 1e-11);
    }
}

TEST(BalanceSolver, PushedAtTheFrictionLimit)
{
  const Problem problem = block({-1., 0., 1.}, 0.6, 0.2, 0.2, 10.);
  EXPECT_FALSE(find_imbalance(problem.qp.feasible_set, problem.balance));
  Vector<double> z(6), alpha(3);
  EXPECT_TRUE(solve(problem, z, alpha).converged);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_NEAR(z[i], 0.2, 1e-9);
  expect_solution(problem, z, alpha, 1e-11);
}

TEST(BalanceSolver, SolutionStartsTheNext)
{
  std::mt19937 random(3);
  const Problem problem = random_problem(60, 3, 1., random);
  Vector<double> z(60), alpha(3);
  EXPECT_TRUE(solve(problem, z, alpha).converged);
  EXPECT_LE(solve(problem, z, alpha).dense_solves, 2u);
}

TEST(BalanceSolver, EndsWithoutSolution)
{
  const Problem problem = block({-1., 1.}, 0., 2., 0.2, 0.); // it tips over
  Vector<double> z(4), alpha(3);
  EXPECT_FALSE(solve(problem, z, alpha).converged);
}

/** The largest `motion.G'z`, component by component: -infinity to infinity where it has no end. */
double resistance(const Problem &problem, const Vector<double> &motion)
{
  Vector<double> direction = problem.balance.along(motion), z(direction.size());
  double sum = 0;
  for (unsigned int i = 0; i < z.size(); ++i)
    z[i] = std::abs(direction[i]) < 1e-12 ? 0. : std::copysign(infinity, direction[i]);
  problem.qp.feasible_set.project(z);
  for (unsigned int i = 0; i < z.size(); ++i)
    sum += z[i] * direction[i];
  return sum;
}

TEST(Imbalance, MotionSeparatesLoadsFromTheSet)
{
  unsigned int n_imbalances = 0;
  for (unsigned int m = 1; m <= 3; ++m)
    for (unsigned int seed = 0; seed < 40; ++seed)
    {
      SCOPED_TRACE("m = " + std::to_string(m) + ", seed " + std::to_string(seed));
      std::mt19937 random(seed);
      Problem problem = random_problem(seed % 2 == 0 ? 4 : 60, m, 1., random);
      EXPECT_FALSE(find_imbalance(problem.qp.feasible_set, problem.balance));
      // No half lines, which together resist anything: a bounded set is left behind.
      FeasibleSet intervals;
      for (unsigned int i = 0; i < problem.qp.d.size(); ++i)
        intervals.add_interval(i % 2 == 0 ? -1. : 0., 1.);
      problem.qp.feasible_set = intervals;
      for (double &e_j : problem.balance.e)
        e_j *= 100.;
      const auto imbalance = find_imbalance(intervals, problem.balance);
      if (!imbalance)
        continue;
      ++n_imbalances;
      EXPECT_NEAR(imbalance->load, imbalance->motion * problem.balance.e,
                  1e-12 * std::abs(imbalance->load));
      EXPECT_NEAR(imbalance->resistance, resistance(problem, imbalance->motion),
                  1e-10 * std::abs(imbalance->load));
      EXPECT_GT(imbalance->load, imbalance->resistance);
    }
  EXPECT_GT(n_imbalances, 80u);
}

/** On the boundary of what a set can carry, a facet or where facets meet, and 1e-8 of it beyond. */
TEST(Imbalance, AtTheLimitAndBeyond)
{
  for (unsigned int m = 1; m <= 3; ++m)
    for (unsigned int seed = 0; seed < 30; ++seed)
    {
      SCOPED_TRACE("m = " + std::to_string(m) + ", seed " + std::to_string(seed));
      std::mt19937 random(seed);
      Problem problem = random_problem(60, m, 1., random);
      problem.qp.feasible_set = unit_box(60);
      const Vector<double> motion = random_vector(m, random);
      Vector<double> z = problem.balance.along(motion);
      for (unsigned int i = 0; i < 60; ++i)
        z[i] = std::copysign(1., z[i]);
      if (seed % 2 == 0) // inside a facet: two rows that the motion does not see
        for (unsigned int i = 0; i + 1 < m; ++i)
        {
          Vector<double> row(m);
          double length = 0, part = 0;
          for (unsigned int j = 0; j < m; ++j)
          {
            length += motion[j] * motion[j];
            part += problem.balance.G(i, j) * motion[j];
          }
          for (unsigned int j = 0; j < m; ++j)
            problem.balance.G(i, j) -= part / length * motion[j];
          z[i] = 0.3;
        }
      problem.balance.G.Tvmult(problem.balance.e, z);
      EXPECT_FALSE(find_imbalance(problem.qp.feasible_set, problem.balance));
      problem.balance.e *= 1 + 1e-8;
      const auto imbalance = find_imbalance(problem.qp.feasible_set, problem.balance);
      ASSERT_TRUE(imbalance);
      EXPECT_GT(imbalance->load, resistance(problem, imbalance->motion));
    }
}

TEST(Imbalance, FrictionAlone)
{
  EqualityConstraints balance{FullMatrix<double>(3, 1), vec({-7.})};
  FeasibleSet set;
  for (unsigned int i = 0; i < 3; ++i)
  {
    balance.G(i, 0) = i - 0.5;
    set.add_interval(-2., 2.);
  }
  const auto imbalance = find_imbalance(set, balance);
  ASSERT_TRUE(imbalance);
  EXPECT_EQ(imbalance->motion, vec({-1.}));
  EXPECT_NEAR(imbalance->load, 7., 1e-13);
  EXPECT_NEAR(imbalance->resistance, 5., 1e-13);
}

/** Lifted off, pushed too hard, and tipping over the point at x = 1. */
TEST(Imbalance, OfABlock)
{
  Problem problem = block({-1., 1.}, 0., 0., 0.2, 0.);
  problem.balance.e = vec({0., -1., 0.});
  auto imbalance = find_imbalance(problem.qp.feasible_set, problem.balance);
  ASSERT_TRUE(imbalance);
  expect_near(imbalance->motion, vec({0., -1., 0.}), 1e-10);
  EXPECT_NEAR(imbalance->load, 1., 1e-10);
  EXPECT_NEAR(imbalance->resistance, 0., 1e-10);

  problem.balance.e = vec({0.5, 1., 0.});
  imbalance = find_imbalance(problem.qp.feasible_set, problem.balance);
  ASSERT_TRUE(imbalance);
  expect_near(imbalance->motion, vec({1., 0., 0.}), 1e-10);
  EXPECT_NEAR(imbalance->resistance, 0.4, 1e-10);

  problem.balance.e = vec({0., 1., 1. + 1e-8});
  imbalance = find_imbalance(problem.qp.feasible_set, problem.balance);
  ASSERT_TRUE(imbalance);
  expect_near(imbalance->motion, vec({0., -1., 1.}), 1e-7);
  EXPECT_NEAR(imbalance->load, 1e-8, 1e-14);
  EXPECT_NEAR(imbalance->resistance, 0., 1e-15);
  problem.balance.e = vec({0., 1., 1.});
  EXPECT_FALSE(find_imbalance(problem.qp.feasible_set, problem.balance));
  problem.balance.e = vec({0., 0., 0.});
  EXPECT_FALSE(find_imbalance(problem.qp.feasible_set, problem.balance));
}
} // namespace
