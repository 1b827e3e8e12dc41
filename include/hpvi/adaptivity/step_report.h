// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_step_report_h
#define hpvi_step_report_h

#include <hpvi/adaptivity/stage_times.h>
#include <hpvi/discretisation/elastic_system.h>
#include <hpvi/discretisation/iterative_refinement.h>
#include <hpvi/discretisation/solution.h>
#include <hpvi/equilibration/error_bound.h>
#include <hpvi/evaluation/contact_state.h>
#include <hpvi/evaluation/energies.h>
#include <hpvi/evaluation/equilibrium.h>
#include <hpvi/evaluation/residual_estimator.h>
#include <hpvi/evaluation/true_error.h>
#include <hpvi/peaks/unbounded_stress.h>
#include <hpvi/solver/coulomb_solver.h>

#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** Where in a history of loads a step stands; all zero without one. */
struct LoadStep
{
  unsigned int number = 0; ///< from 1
  double t = 0;
  /** From the beginning of the history to the end of the load step, once it is reached: */
  double work = 0;       ///< the sum of Work::external [stress length^dim]
  double dissipated = 0; ///< the sum of Work::dissipated, likewise
  double stored = 0;     ///< a(u_N,u_N)/2, likewise
  double released = 0;   ///< the sum of Work::released, likewise
  double unbalanced = 0; ///< the sum of Work::unbalanced, likewise
};

/** Everything known after one SOLVE, ESTIMATE; references live until the next step begins. */
template <int dim>
struct StepReport
{
  unsigned int number; ///< from 1
  const Solution<dim> &solution;
  const ElasticSystem<dim> &system; ///< of the discrete problem
  const ErrorEstimate &estimate;
  /**
   * eta/c^{1/2}, in the unit of the energy norm. The residual bounds the error through
   * `c |eps(v)|^2 <= a(v,v)`, so this factor is the whole influence of the materials:
   * Scene::coercivity(), 2 mu of the softest unless nu < 0.
   */
  double scaled_estimate;
  double relative_estimate; ///< scaled_estimate / |u_N|_a, dimensionless: the relative indicator
  const std::optional<ErrorBound> &bound; ///< none: not asked for, or Scene::no_error_bound()
  std::string no_bound;                   ///< why there is none
  double bound_imbalance; ///< ErrorBound::imbalance, also where that is why; NaN: not computed
  double relative_bound;  ///< bound->total / |u_N|_a, NaN without it
  Energies energies;
  std::vector<ContactState<dim>> contact; ///< of each contact boundary, by id
  TrueErrors errors;                      ///< NaN where the scene gives nothing to compare with
  AlgebraicError algebraic;               ///< what round-off leaves in u_N
  QpReport qp;                            ///< all zero without multipliers
  CoulombReport coulomb;                  ///< likewise without Coulomb friction
  double condition_raw = 0;               ///< cond(S), 0 unless the scene asks for it
  double condition_scaled = 0;            ///< cond(D^-1/2 S D^-1/2), likewise
  StageTimes times;
  double seconds = 0;                ///< since the start of the run, without output and true errors
  std::string stopped_by;            ///< empty, or the limit that makes this the last step
  std::vector<std::string> warnings; ///< of the last step: what in the result asks for care
  Equilibrium<dim> equilibrium;      ///< likewise of the last step alone
  LoadStep load;
  std::vector<StressSample<dim>> peaks = {};        ///< stress_peaks()
  std::vector<UnboundedStress<dim>> unbounded = {}; ///< of the last step alone
};

} // namespace hpvi

#endif
