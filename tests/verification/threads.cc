// SPDX-License-Identifier: LGPL-2.1-or-later
// One scene on several threads: the same numbers to the last bit, and the same ways to end.
#include "discretisation.h"

#include <gtest/gtest.h>
#include <hpvi/algebra/linear_solver.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/driver/load_history.h>

#include <atomic>
#include <string>
#include <vector>

namespace
{
using namespace verification;

/** Of a grid of n x n unknowns, each coupled to its neighbours and to those two away. */
SymmetricMatrix grid(const unsigned int n)
{
  SymmetricMatrix A;
  for (unsigned int j = 0; j < n * n; ++j)
  {
    for (const unsigned int distance : {2 * n, n + 1, n, n - 1, 2U, 1U})
      if (distance <= j)
      {
        A.row.push_back(j - distance);
        A.value.push_back(-1. / distance);
      }
    A.row.push_back(j);
    A.value.push_back(4. + 0.001 * (j % 7));
    A.column_start.push_back(A.row.size());
  }
  return A;
}

TEST(Supernodes, AreTheSameOnAnyThreads)
{
  const SymmetricMatrix A = grid(60);
  std::vector<unsigned int> kept;
  for (unsigned int k = 5; k < A.n(); k += 15)
    kept.push_back(k); // so many that their supernode has several panels
  dealii::Vector<double> f(A.n()), residual;
  for (unsigned int k = 0; k < A.n(); ++k)
    f[k] = 1. + k % 3;
  std::vector<std::vector<double>> results;
  for (const unsigned int n_threads : {1U, 2U, 3U})
  {
    const ThreadPool pool(n_threads);
    const LinearSolver solver(A, kept);
    const dealii::Vector<double> x = solver.solve(f);
    residual = f;
    for (unsigned int column = 0; column < A.n(); ++column)
      for (int k = A.column_start[column]; k < A.column_start[column + 1]; ++k)
      {
        residual[A.row[k]] -= A.value[k] * x[column];
        if (A.row[k] != int(column))
          residual[column] -= A.value[k] * x[A.row[k]];
      }
    EXPECT_LT(residual.linfty_norm(), 1e-11);
    results.emplace_back(x.begin(), x.end());
    const auto &C = solver.kept_factor();
    for (unsigned int j = 0; j < kept.size(); ++j)
      for (unsigned int i = j; i < kept.size(); ++i)
        results.back().push_back(C(i, j));
    EXPECT_EQ(results.back(), results.front());
    for (const unsigned int column : {1800U, kept.front(), kept.back()})
    {
      SymmetricMatrix indefinite = A;
      indefinite.value[indefinite.column_start[column + 1] - 1] = -1.;
      EXPECT_THROW(LinearSolver(indefinite, kept), NumericalFailure);
    }
  }
}

void append(const std::vector<double> &values, std::vector<double> &to)
{
  for (const double value : values)
    to.push_back(std::isnan(value) ? -12345. : value); // equal to itself
}

/** Every number of every step. */
std::vector<double> numbers(const std::string &name, Overrides overrides,
                            const unsigned int n_threads)
{
  overrides.emplace_back("Solver/Threads", std::to_string(n_threads));
  const Scene<2> scene = shipped_scene(name, overrides);
  std::vector<double> result;
  LoadHistory<2> solver(scene);
  solver.run(
      [&](const StepReport<2> &step)
      {
        if (const auto state = solver.state()) // from which a run goes on
          append({double(state->refinements.size()), double(state->history.size())}, result);
        const Solution<2> &solution = step.solution();
        append(std::vector<double>(solution.u.begin(), solution.u.end()), result);
        append(std::vector<double>(solution.z.begin(), solution.z.end()), result);
        append({step.scaled_estimate, step.energies.energy, step.energies.lagrangian,
                step.energies.norm, step.errors.energy, step.bound_imbalance},
               result);
        for (const auto *part : {&step.estimate.volume, &step.estimate.jumps,
                                 &step.estimate.neumann, &step.estimate.contact})
          append(*part, result);
        if (step.bound)
        {
          append({step.bound->total, step.bound->energy, step.bound->theta, step.bound->radius},
                 result);
          append(step.bound->squares, result);
        }
        for (const Resultant<2> &force : step.forces)
          append(std::vector<double>{force.force[0].value, force.force[1].value,
                                     force.force[0].best()},
                 result);
      });
  return result;
}

struct Kind
{
  std::string name;
  Overrides overrides;
};

using ThreadsOfAScene = ::testing::TestWithParam<Kind>;

TEST_P(ThreadsOfAScene, GiveTheSameNumbers)
{
  const auto &[name, overrides] = GetParam();
  const std::vector<double> alone = numbers(name, overrides, 1);
  EXPECT_GT(alone.size(), 1000U);
  for (const unsigned int n_threads : {2U, 3U})
    EXPECT_EQ(numbers(name, overrides, n_threads), alone) << n_threads << " threads";
}

const auto steps(const char *const n)
{
  return std::make_pair(std::string("Adaptivity/Maximum steps"), std::string(n));
}

INSTANTIATE_TEST_SUITE_P(
    OfAllKinds, ThreadsOfAScene,
    ::testing::Values(Kind{"han-6-12", {steps("11")}}, Kind{"han-6-13", {steps("9")}},
                      Kind{"resting", {steps("6")}}, Kind{"ssnv128", {steps("7")}},
                      Kind{"plane-strain", {steps("6")}}, Kind{"stack", {steps("4")}},
                      Kind{"bolt", {steps("3")}}, Kind{"press-ring", {steps("4")}},
                      Kind{"press-ring-axi", {steps("4")}}, Kind{"punch-plate", {steps("5")}},
                      Kind{"bimetal", {steps("4")}},
                      Kind{
                          "hertz", // ends by the bound: no step is solved ahead that may be in vain
                          {{"Adaptivity/Tolerance", "0.05"}, {"Adaptivity/Tolerance on", "bound"}}},
                      Kind{"propped", {steps("5"), {"Error/Bound", "last step"}}},
                      Kind{"fretting", {steps("3"), {"Loading/Steps", "2"}}}),
    [](const auto &kind)
    {
      std::string name = kind.param.name;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

/** Whoever listens may give up at any stage; the steps before are told, and nothing stays behind. */
TEST(ThreadsAtTheEnd, EndWhenTheListenerHasEnough)
{
  const Scene<2> scene =
      shipped_scene("han-6-12", {{"Solver/Threads", "3"}, {"Adaptivity/Maximum steps", "6"}});
  for (const unsigned int last : {3U, 12U, 13U, 14U, 15U, 16U, 17U, 18U, 30U})
  {
    unsigned int n_heard = 0, n_told = 0, step = 0;
    EXPECT_THROW(AdaptiveSolver<2>(scene).run([&](const StepReport<2> &) { ++n_told; },
                                              [&](const Progress &progress)
                                              {
                                                step = progress.step;
                                                if (++n_heard == last)
                                                  throw NumericalFailure("enough");
                                              }),
                 NumericalFailure);
    EXPECT_EQ(n_told, step - 1);
    EXPECT_EQ(pool_size(), 1U);
  }
}

/** With threads the next step is on its way before this one is told, and their seconds are shares of the time that passes. */
TEST(ThreadsAtTheEnd, SolveTheNextStepMeanwhile)
{
  for (const unsigned int n_threads : {1U, 2U})
  {
    const Scene<2> scene =
        shipped_scene("han-6-12", {{"Solver/Threads", std::to_string(n_threads)}, steps("5")});
    unsigned int heard = 0;
    const dealii::Timer timer;
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          EXPECT_EQ(heard, step.number + (n_threads > 1 && step.number < 5 ? 1 : 0));
          EXPECT_LE(step.seconds, timer.wall_time());
          for (const auto &[name, seconds] : step.times.named())
            EXPECT_GE(seconds, 0.) << name;
          EXPECT_GT(step.times.bound, 0.);
          EXPECT_GT(step.times.factor, 0.);
        },
        [&](const Progress &progress) { heard = progress.step; });
  }
}

TEST(ThreadsAtTheEnd, EndWhenTimeIsOver)
{
  unsigned int n_steps = 0;
  std::string why;
  each_step<2>(
      shipped_scene("han-6-12", {{"Solver/Threads", "3"}, {"Adaptivity/Maximum seconds", "0.001"}}),
      [&](const StepReport<2> &step)
      {
        ++n_steps;
        why = text(step.stopped_by);
      });
  EXPECT_EQ(n_steps, 1U);
  EXPECT_EQ(why, "Maximum seconds");
}

/** A load that is refused in all cells by the indicator: that of the first one is told. */
TEST(ThreadsAtTheEnd, RefuseTheSamePoint)
{
  std::vector<std::string> messages;
  for (const unsigned int n_threads : {1U, 3U})
  {
    Scene<2> scene = shipped_scene("han-6-12", {{"Solver/Threads", std::to_string(n_threads)},
                                                {"Geometry/Subdivisions", "8, 8"}});
    std::atomic<bool> is_refused(false);
    scene.body_force[1] = expression<2>(std::function<double(const dealii::Point<2> &)>(
        [&](const dealii::Point<2> &x)
        {
          if (is_refused)
            throw InputError("not at " + in_digits(x[0]) + ", " + in_digits(x[1]));
          return 0.01;
        }));
    const auto on_stage = [&](const Progress &progress)
    { is_refused = progress.stage.rfind("estimating", 0) == 0; };
    messages.push_back(failure_of<InputError>(
        [&] { AdaptiveSolver<2>(scene).run([](const StepReport<2> &) {}, on_stage); }));
    EXPECT_EQ(pool_size(), 1U);
  }
  EXPECT_EQ(messages[0], messages[1]);
  EXPECT_NE(messages[0], "");
}
} // namespace
