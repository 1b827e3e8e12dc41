// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_adaptive_solver_h
#define hpvi_adaptive_solver_h

#include <hpvi/base/numerical_failure.h>
#include <hpvi/discretisation/iterative_refinement.h>
#include <hpvi/discretisation/solution.h>
#include <hpvi/evaluation/energies.h>
#include <hpvi/evaluation/equilibrium.h>
#include <hpvi/evaluation/residual_estimator.h>
#include <hpvi/evaluation/true_error.h>
#include <hpvi/solver/mprgp.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace hpvi
{
/** Seconds spent in each stage of one step. */
struct StageTimes
{
  double setup = 0;    ///< unknowns, constraints, contact space
  double assemble = 0; ///< A, f, B
  double factor = 0;   ///< analysis, factorisation, reduction to the contact boundary
  double qp = 0;       ///< the quadratic program
  double recover = 0;  ///< u from the multiplier, energies
  double estimate = 0; ///< residual indicator
  double decide = 0;   ///< smoothness, marking
  double refine = 0;   ///< bisection that led to this step

  /** Name and seconds of every stage, in the order in which they run. */
  std::array<std::pair<const char *, double>, 8> named() const
  {
    return {{{"setup", setup},
             {"assemble", assemble},
             {"factor", factor},
             {"qp", qp},
             {"recover", recover},
             {"estimate", estimate},
             {"decide", decide},
             {"refine", refine}}};
  }

  double total() const
  {
    double sum = 0;
    for (const auto &stage : named())
      sum += stage.second;
    return sum;
  }

  StageTimes &operator+=(const StageTimes &other)
  {
    for (const auto stage :
         {&StageTimes::setup, &StageTimes::assemble, &StageTimes::factor, &StageTimes::qp,
          &StageTimes::recover, &StageTimes::estimate, &StageTimes::decide, &StageTimes::refine})
      this->*stage += other.*stage;
    return *this;
  }
};

/** Everything known after one SOLVE, ESTIMATE; references live until the next step begins. */
template <int dim>
struct Step
{
  unsigned int number; ///< from 1
  const Solution<dim> &solution;
  const ErrorEstimate &estimate;
  /**
   * eta/c^{1/2}, in the unit of the energy norm. The residual bounds the error through
   * `c |eps(v)|^2 <= a(v,v)`, so this factor is the whole influence of the materials:
   * Scene::coercivity(), 2 mu of the softest unless nu < 0.
   */
  double scaled_estimate;
  double relative_estimate; ///< scaled_estimate / |u_N|_a, dimensionless: the relative indicator
  Energies energies;
  TrueErrors errors;           ///< NaN where the scene gives nothing to compare with
  AlgebraicError algebraic;    ///< what round-off leaves in u_N
  QpReport qp;                 ///< all zero without multipliers
  double condition_raw = 0;    ///< cond(S), 0 unless the scene asks for it
  double condition_scaled = 0; ///< cond(D^-1/2 S D^-1/2), likewise
  StageTimes times;
  double seconds = 0;                ///< since the start of the run, without output and true errors
  std::string stopped_by;            ///< empty, or the limit that makes this the last step
  std::vector<std::string> warnings; ///< of the last step: what in the result asks for care
  Equilibrium<dim> equilibrium;      ///< likewise of the last step alone
};

/** What a run is about to do, for those who wait for it. */
struct Progress
{
  unsigned int step; ///< from 1
  std::string stage; ///< as in "factorising 120000 unknowns"
  std::string note;  ///< what to know before that, one line; mostly empty
};

/**
 * SOLVE => ESTIMATE => MARK => REFINE (thesis, Section 4.3) for one scene. Owns the stages; prints
 * nothing and writes no file: each finished step goes to a callback.
 */
template <int dim>
class AdaptiveSolver
{
public:
  /** Throws InputError where the scene does not pass Scene::check(). */
  explicit AdaptiveSolver(const Scene<dim> &scene);
  ~AdaptiveSolver();

  /**
   * Runs until a limit of the scene is reached; @p about_to hears of every stage before it begins, and
   * may throw to give up the step. Throws NumericalFailure.
   */
  void run(
      const std::function<void(const Step<dim> &)> &finished_step,
      const std::function<void(const Progress &)> &about_to = [](const Progress &) {});

private:
  struct Stages;
  std::unique_ptr<Stages> stages;
};
} // namespace hpvi

#endif
