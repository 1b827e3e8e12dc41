// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_history_h
#define hpvi_history_h

#include <hpvi/results/stress_extrema.h>
#include <hpvi/results/warnings/claim.h>

#include <limits>
#include <string>
#include <vector>

namespace hpvi
{
/** What limits and warnings ask of a step when it is over, numbers of all processes. */
template <int dim>
struct PastStep
{
  double estimate;          ///< eta, stress length^(dim/2)
  double relative_estimate; ///< as StepReport has it
  /** ErrorBound::total / |u_N|_a, NaN where none is guaranteed. */
  double relative_bound = std::numeric_limits<double>::quiet_NaN();
  /** Of Adaptivity::tolerance_column, its half-width over its value; NaN: there is none. */
  double relative_half_width = std::numeric_limits<double>::quiet_NaN();
  double seconds = 0;           ///< from the start of the run to the end of the step
  bool lacks_condition = false; ///< asked for cond(S), which S did not have up to round-off
  double hysteresis = 0;        ///< ErrorBound::hysteresis
  std::vector<StressSample<dim>> extrema = {}; ///< stress_extrema(): which ones grow without bound
  Claims claims = {};                          ///< what it guarantees
  /** Of these and those of steps before, contradiction(); then nothing is guaranteed from this step on. */
  std::string contradiction = {};
};

/** All finished steps of a run, the first one first. */
template <int dim>
using History = std::vector<PastStep<dim>>;

/** The first contradiction of its first @p n steps; empty: there is none. */
template <int dim>
std::string first_contradiction(const History<dim> &history, const std::size_t n)
{
  for (std::size_t k = 0; k < n; ++k)
    if (!history[k].contradiction.empty())
      return history[k].contradiction;
  return {};
}
} // namespace hpvi

#endif
