// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stage_times_h
#define hpvi_stage_times_h

#include <deal.II/base/timer.h>

#include <array>
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
  double bound = 0;    ///< guaranteed bound of the error
  double decide = 0;   ///< smoothness, marking
  double refine = 0;   ///< bisection that led to this step

  /** Name and seconds of every stage, in the order in which they run. */
  std::array<std::pair<const char *, double>, 9> named() const
  {
    return {{{"setup", setup},
             {"assemble", assemble},
             {"factor", factor},
             {"qp", qp},
             {"recover", recover},
             {"estimate", estimate},
             {"bound", bound},
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
    for (double StageTimes::*const stage : stages)
      this->*stage += other.*stage;
    return *this;
  }

  StageTimes &operator*=(const double factor)
  {
    for (double StageTimes::*const stage : stages)
      this->*stage *= factor;
    return *this;
  }

private:
  static const std::array<double StageTimes::*, 9> stages;
};

inline const std::array<double StageTimes::*, 9> StageTimes::stages = {
    {&StageTimes::setup, &StageTimes::assemble, &StageTimes::factor, &StageTimes::qp,
     &StageTimes::recover, &StageTimes::estimate, &StageTimes::bound, &StageTimes::decide,
     &StageTimes::refine}};

/** Adds the wall time of its own life to a stage. */
class StageTimer
{
public:
  explicit StageTimer(double &seconds) : seconds(seconds)
  {
  }
  ~StageTimer()
  {
    seconds += timer.wall_time();
  }

private:
  dealii::Timer timer;
  double &seconds;
};
} // namespace hpvi

#endif
