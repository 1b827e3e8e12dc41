// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_metamorphic_outcome_h
#define hpvi_metamorphic_outcome_h

#include "frame.h"

#include <deal.II/base/point.h>
#include <hpvi/results/contact_state.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace metamorphic
{
/** A zone of contact in the body's own frame, from corner to corner as the body counts them. */
struct Zone
{
  hpvi::ContactMode mode;
  Point<2> begin, end;
};

/** What one side does, in the body's own frame. */
struct SideOutcome
{
  Tensor<1, 2> force;
  double moment = 0, pressure = 0, friction = 0; ///< largest pressure; int T_t against the tangent
  std::vector<Zone> zones;
};

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/** Of one adaptive step, in the units of the body's own frame; what is unknown is compared with nothing. */
struct StepOutcome
{
  std::array<unsigned int, 21> cells{}; ///< by degree
  unsigned int n_unknowns = 0, n_multipliers = 0;
  double energy = unknown, lagrangian = unknown, norm = unknown, estimate = unknown;
  double bound = unknown, low = unknown, high = unknown; ///< where it is guaranteed
  double mises = unknown, across = unknown;              ///< of the mean stress over a disc
  double t = 0, work = unknown, dissipated = unknown;    ///< of a load history
  double missed = 0; ///< of its loads, by what its rule and a finer one differ
  bool misses_load =
      false; ///< does it warn, as a last step, of a datum that its rule does not resolve?
};

/** How a run of a scene ended. */
struct Outcome
{
  std::string refusal; ///< the kind of error that ended the run, or empty
  std::string words;   ///< what it said
  std::vector<StepOutcome> steps;
  std::array<SideOutcome, 8> sides; ///< of the last step, by the body's own numbers; parts follow
  double all_forces = 0;            ///< sum of their absolute values and of the load
  double stiffness = 0;             ///< Young's modulus, of the stiffest material
};

/** Solves the scene @p file, told in @p frame. */
Outcome solve(const std::string &file, const Frame &frame);

/** The same problem by the primal path: energies alone. */
Outcome solve_primal(const std::string &file, const Frame &frame);

/** How near two outcomes have to be. */
struct Tolerances
{
  double energy = 1e-8; ///< of Lagrangians, norms and indicators, beside the energy norm
  double friction =
      1e-6; ///< of J likewise: its int g |u_t| is cut where samples show a change of sign
  double force = 1e-6;          ///< of forces beside all of them
  double bound = 1e-6;          ///< of the bound beside itself
  double place = 1e-6;          ///< of transitions [length]
  bool same_multipliers = true; ///< have both as many, and the same contact boundaries?
  bool same_bounds = true;      ///< does one have a bound where the other has?
};

/** What differs, a line each; empty: nothing. */
std::vector<std::string> differences(const Outcome &one, const Outcome &other,
                                     const Tolerances &tolerances);

/** The same of refusals and energies alone. */
std::vector<std::string> energy_differences(const Outcome &one, const Outcome &other,
                                            const Tolerances &tolerances);

/** Where no interval of energy of one meets the last one of the other, a line. */
std::vector<std::string> disjoint_intervals(const Outcome &one, const Outcome &other);
} // namespace metamorphic

#endif
