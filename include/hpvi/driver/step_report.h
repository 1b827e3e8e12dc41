// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_step_report_h
#define hpvi_step_report_h

#include <hpvi/driver/backend.h>
#include <hpvi/driver/finished_loads.h>
#include <hpvi/driver/stop.h>
#include <hpvi/results/probe_value.h>
#include <hpvi/results/resultant.h>
#include <hpvi/results/stress_singularity.h>

#include <deal.II/base/exceptions.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * Everything known after one SOLVE, ESTIMATE, whichever backend solved; numbers are those of all processes and
 * the same on each of them, unless it says otherwise. References live until the next step begins.
 */
template <int dim>
struct StepReport
{
  unsigned int number; ///< from 1
  const Scene<dim> &scene;
  const Field<dim> &field; ///< u_N on the cells of this process
  ProblemSize size;
  const ErrorEstimate &estimate;   ///< of the cells of this process, for unit thickness
  EstimateNorms norms;             ///< of all cells
  std::optional<ErrorBound> bound; ///< none: not asked for, or not on offer
  std::string no_bound;            ///< why there is none
  double energy_high;              ///< Backend::energy_high() [stress length^dim]
  double bound_imbalance; ///< ErrorBound::imbalance, also where that is why; NaN: not computed
  const std::optional<ReducedPart<dim>> reduced; ///< of the reduced path
  const std::optional<PrimalPart<dim>> primal;   ///< of the primal path
  /**
   * eta/c^{1/2}, in the unit of the energy norm. The residual bounds the error through
   * `c |eps(v)|^2 <= a(v,v)`, so this factor is the whole influence of the materials:
   * Scene::reference_coercivity(), 2 mu of the first unless nu < 0; residuals weigh by it and their own.
   */
  double scaled_estimate = 0;
  double relative_estimate = 0; ///< scaled_estimate / |u_N|_a: the relative indicator
  double relative_bound = 0;    ///< ErrorBound::total / |u_N|_a, NaN without it

  /** Where there is a bound or, in its place, an estimate: */
  struct Equilibrated
  {
    double norm = std::numeric_limits<double>::quiet_NaN();     ///< ErrorBound::estimate
    double relative = std::numeric_limits<double>::quiet_NaN(); ///< over |u_N|_a
    double coupling = std::numeric_limits<double>::quiet_NaN(); ///< ErrorBound::coupling
    std::string kind, zones;    ///< text(BoundKind), ErrorBound::zones
    std::string coupling_known; ///< ErrorBound's
  };
  Equilibrated equilibrated{};
  Energies energies{};
  std::vector<ContactState<dim>>
      contact{};           ///< of each contact boundary, by id; the first process's
  TrueErrors errors{};     ///< NaN where the scene gives nothing to compare with
  StageTimes times{};      ///< of the first process
  double seconds = 0;      ///< since the start of the run, without output and true errors
  double peak_memory = 0;  ///< that the processes have had so far, their sum [bytes]
  StopReason stopped_by{}; ///< what makes this the last step, if it is that
  Warnings warnings{};     ///< of the last step: what in the result asks for care
  Equilibrium<dim> equilibrium{};
  LoadStep load{};
  HistorySoFar history{};                          ///< of a load step that is over
  std::vector<StressSample<dim>> extrema{};        ///< stress_extrema()
  std::vector<StressSingularity<dim>> unbounded{}; ///< of the last step alone
  std::vector<Resultant<dim>> forces{};            ///< the rows of forces.csv
  std::vector<ProbeValue<dim>> probes{};           ///< of each of Scene::probes but lines
  std::vector<ProbeLine<dim>> probe_lines{};       ///< of these
  std::string no_intervals{}; ///< why forces and probes have no intervals; empty: some have
  /** Guaranteed intervals, of this step or of those before, that do not meet, in words: nothing is guaranteed; empty: all meet. */
  std::string contradiction{};
  PlacedValue<dim> largest_displacement{}; ///< |u_N| [length], of the last step alone

  /** Of the reduced path, which alone has one. */
  const Solution<dim> &solution() const
  {
    AssertThrow(reduced, dealii::ExcMessage("Only the reduced path has a Solution; ask field."));
    return reduced->solution;
  }
};
} // namespace hpvi

#endif
