// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_finished_loads_h
#define hpvi_finished_loads_h

#include <hpvi/results/contact_history.h>
#include <hpvi/results/warnings/warnings.h>
#include <hpvi/scene/data_scale.h>

namespace hpvi
{
/** Where in a history of loads a step stands; all zero without one. */
struct LoadStep
{
  unsigned int number = 0; ///< from 1
  double t = 0;
  /** From the beginning of the history to the end of the load step, once it is reached: */
  double work = 0;        ///< the sum of Work::external [stress length^dim]
  double dissipated = 0;  ///< the sum of Work::dissipated, likewise
  double stored = 0;      ///< a(u_N,u_N)/2, likewise
  double released = 0;    ///< the sum of Work::released, likewise
  double unbalanced = 0;  ///< the sum of Work::unbalanced, likewise
  double trapezoidal = 0; ///< the sum of Work::trapezoidal, likewise
  unsigned int cycle = 0; ///< Loading::cycle()
  bool is_last = false;   ///< of the history, once it is over
};

/** One of the cycles of Loading::until_steady. */
struct LoadCycle
{
  unsigned int load_step; ///< its last one
  double work;            ///< in this cycle [stress length^dim]
  double dissipated;      ///< likewise
  /** |dissipated - that of the cycle before| over the larger; 0 where both are round-off of the work, infinite in the first. */
  double change;
};

/** Does friction dissipate the same in the last of @p cycles as in the one before, up to @p share, or no more than that of the largest? */
bool are_steady(const std::vector<LoadCycle> &cycles, double share);

/** The largest value of something at the ends of load steps so far. */
struct HistoryLargest
{
  double value = 0;
  std::array<double, 3> where{};
  unsigned int boundary = dealii::numbers::invalid_boundary_id; ///< of contact
  unsigned int load_step = 0;                                   ///< 0: there is none
  double t = 0;
};

/** What lasts from load step to load step, for those who look at a history. */
struct HistorySoFar
{
  std::vector<ContactHistory> contact; ///< the first process's
  std::vector<LoadCycle> cycles;       ///< that are over
  HistoryLargest pressure, von_mises;  ///< [stress]
  HistoryLargest
      opening; ///< of unilateral contact: min(u_0 - [u]_n, -[u]_n), what loads have opened [length]
};

/** What the load steps of a history leave to the next one, besides the solution of the last of them. */
struct FinishedLoads
{
  LoadStep load;            ///< the last of them
  unsigned int n_steps = 0; ///< of all
  double seconds = 0;       ///< likewise
  double slipped = 0;       ///< the largest |u_t| along the contact of the primal path
  double initial_part = 0;  ///< of stored energy: initial_energy()
  unsigned int first = 0;   ///< load step with an error; 0: none yet
  double tolerance = 0;     ///< that it sets for those after it
  DataScale past_data;      ///< of the scene of the last, as load_step() got it
  DataScale data;           ///< likewise, as it was solved
  Warnings warnings;        ///< the worst of each kind
  HistorySoFar so_far;
};
} // namespace hpvi

#endif
