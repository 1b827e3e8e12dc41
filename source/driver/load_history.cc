// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/input_error.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/text.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/plane/interpolation.h>
#include <hpvi/plane/tangential_trace.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/data_scale.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The end of a load step, from whose slip the next one counts. */
template <int dim>
struct Past
{
  std::shared_ptr<const Scene<dim>> scene; ///< of the solution, which it has to outlive
  Solution<dim> solution;
};

/** Along the contact of the primal path, of all processes: what stands for data of the next load step. */
template <int dim>
double largest_slip(const StepReport<dim> &step)
{
  double largest = 0;
  for (const ContactState<dim> &state : step.contact)
    for (const ContactPoint<dim> &point : state.points)
      largest = std::max(largest, size_of(point.tangential_jump));
  return step.primal ? Utilities::MPI::max(largest, step.field.communicator()) : 0.;
}
} // namespace

bool are_steady(const std::vector<LoadCycle> &cycles, const double share)
{
  if (cycles.size() < 2)
    return false;
  double largest = 0;
  for (const LoadCycle &cycle : cycles)
    largest = std::max(largest, cycle.dissipated);
  // Where a contact shakes down each cycle takes a part of the one before, however late it is.
  return cycles.back().change <= share || cycles.back().dissipated <= share * largest;
}

template <int dim>
struct LoadHistory<dim>::Evolution
{
  const Scene<dim> &scene;
  const MPI_Comm communicator;
  std::shared_ptr<const Scene<dim>> current; ///< the scene of the load step
  std::unique_ptr<AdaptiveSolver<dim>> solver;
  std::optional<Past<dim>> past; ///< of the reduced path
  FinishedLoads finished;        ///< load: that at hand
  bool has_ended = false;        ///< that load step

  Evolution(const Scene<dim> &scene, MPI_Comm communicator);

  Evolution(const Scene<dim> &scene, const RunState<dim> &state, MPI_Comm communicator);

  void begin(unsigned int number);
  void go_on_after(const RunState<dim> &state);
  bool keeps_mesh() const;
  StepReport<dim> report(const StepReport<dim> &step) const;
  StopReason reason(Stop stop) const;
  void add_warnings(StepReport<dim> &report) const;
  void conclude(StepReport<dim> &report);
  PastSlip<dim> slip_so_far() const;
  void count(const Work &done);
  void count_work(const ReducedPart<dim> &part);
  void count_largest(const StepReport<dim> &report);
  void count_cycle();
  bool is_over() const;
  std::string place() const;
};

template <int dim>
LoadHistory<dim>::Evolution::Evolution(const Scene<dim> &scene, MPI_Comm communicator)
    : scene(scene), communicator(communicator)
{
  if (scene.has_load_history())
  {
    check(scene);
    begin(1);
  }
  else
    solver = std::make_unique<AdaptiveSolver<dim>>(scene, communicator);
}

template <int dim>
LoadHistory<dim>::Evolution::Evolution(const Scene<dim> &scene, const RunState<dim> &state,
                                       MPI_Comm communicator)
    : scene(scene), communicator(communicator)
{
  state.require_scene(scene, hpvi::n_processes(communicator));
  if (scene.has_load_history() != state.loads.has_value())
    RunState<dim>::format().reject(state.name,
                                   "the scene or the run state has a load history, and not both");
  if (scene.has_load_history())
    go_on_after(state);
  else
    solver = std::make_unique<AdaptiveSolver<dim>>(scene, state, communicator);
}

/** The load step that has ended is built again, and the next one begins from it as it would have. */
template <int dim>
void LoadHistory<dim>::Evolution::go_on_after(const RunState<dim> &state)
{
  finished = *state.loads;
  const unsigned int number = finished.load.number;
  if (is_over())
    RunState<dim>::format().reject(state.name, "there is nothing to go on with after load step " +
                                                   std::to_string(number) + ", the last one");
  check(scene);
  const auto last = std::make_shared<Scene<dim>>(load_step(scene, number, finished.past_data));
  last->past_data = finished.data;
  current = last;
  solver = std::make_unique<AdaptiveSolver<dim>>(*current, state, communicator);
  if (const auto reduced = solver->reduced())
    past.emplace(Past<dim>{current, reduced->solution});
  begin(number + 1);
}

template <int dim>
void LoadHistory<dim>::Evolution::begin(const unsigned int number)
{
  finished.load.number = number;
  finished.load.t = scene.loading.time(number);
  finished.load.cycle = scene.loading.cycle(number);
  has_ended = false;
  finished.past_data = current ? data_scale(*current) : DataScale();
  const auto next = std::make_shared<Scene<dim>>(load_step(scene, number, finished.past_data));
  if (!solver)
  {
    current = next;
    solver = std::make_unique<AdaptiveSolver<dim>>(*current, communicator);
    return;
  }
  const PastSlip<dim> slip = slip_so_far();
  const std::vector<Side<dim>> sides = sides_of(scene);
  for (const auto &[boundary, u_t] : slip)
    for (const Point<dim> &x : sides[boundary].sample())
      next->past_data.displacement =
          std::max(next->past_data.displacement, std::abs(u_t->value(x)));
  next->past_data.displacement = std::max(next->past_data.displacement, finished.slipped);
  if (keeps_mesh())
    next->adaptivity.maximum_steps = 1;
  if (next->adaptivity.tolerance == 0)
  {
    next->adaptivity.tolerance = finished.tolerance;
    next->adaptivity.tolerance_on = Indicator::residual;
    next->adaptivity.tolerance_column.clear();
  }
  const auto last = std::exchange(current, next); // the solver refers to it
  solver = std::make_unique<AdaptiveSolver<dim>>(*current, *solver, slip);
}

/** From which the next load step counts. */
template <int dim>
PastSlip<dim> LoadHistory<dim>::Evolution::slip_so_far() const
{
  if constexpr (dim == 2)
    if (past)
      return past_slip(past->solution.contact_space, past->solution.displacement_space,
                       past->solution.tables, past->solution.u);
  return {};
}

/** What is exact on the coarse mesh, as no load at all, says nothing of the mesh that others need. */
template <int dim>
bool LoadHistory<dim>::Evolution::keeps_mesh() const
{
  return scene.loading.adapt == LoadAdaptivity::first_step && finished.first > 0 &&
         finished.first < finished.load.number;
}

/** Why the load step is done, where that is no limit that the scene names. */
template <int dim>
StopReason LoadHistory<dim>::Evolution::reason(const Stop stop) const
{
  if (stop == Stop::tolerance && scene.adaptivity.tolerance == 0)
    return {Stop::load_step, finished.first};
  return {stop == Stop::maximum_steps && keeps_mesh() ? Stop::first_step : stop};
}

/** @p step, one of the load step, as one of the whole run. */
template <int dim>
StepReport<dim> LoadHistory<dim>::Evolution::report(const StepReport<dim> &step) const
{
  StepReport<dim> result = step;
  result.number += finished.n_steps;
  result.seconds += finished.seconds;
  result.load = finished.load;
  return result;
}

/** What only the history can say of a load step, and of all when the last one is over. */
template <int dim>
void LoadHistory<dim>::Evolution::add_warnings(StepReport<dim> &report) const
{
  if (report.stopped_by.stop != Stop::round_off)
    report.warnings = joined(report.warnings, load_step_warnings(report.relative_estimate));
  const LoadStep &load = finished.load;
  if (load.is_last)
    report.warnings = joined(
        report.warnings,
        scene.has_friction() ? dissipation_warnings(load.dissipated, load.trapezoidal,
                                                    std::abs(load.work) + load.stored)
                             : Warnings(), // what joints do between their points is none
        scene.loading.until_steady == 0 ||
                are_steady(finished.so_far.cycles, scene.loading.until_steady)
            ? Warnings()
            : steady_warnings(finished.so_far.cycles.back().change, scene.loading.until_steady));
}

/** The last step of a load step: what the load step did, and what the next one starts from. */
template <int dim>
void LoadHistory<dim>::Evolution::conclude(StepReport<dim> &report)
{
  if (report.reduced)
    count_work(*report.reduced);
  if (report.primal)
    count(report.primal->work_done());
  finished.slipped = std::max(finished.slipped, largest_slip(report));
  finished.load.stored = 0.5 * report.energies.norm * report.energies.norm + finished.initial_part;
  count_largest(report);
  add_load_step(*current, report.contact, 1. / scene.loading.steps, finished.so_far.contact);
  count_cycle();
  finished.load.is_last = is_over();
  report.load = finished.load;
  report.history = finished.so_far;
  finished.n_steps = report.number;
  finished.seconds = report.seconds;
  report.stopped_by = reason(report.stopped_by.stop);
  if (finished.first == 0 && report.stopped_by.stop != Stop::round_off)
  {
    finished.first = finished.load.number;
    finished.tolerance = 1.2 * report.relative_estimate;
  }
  finished.data = current->past_data;
  has_ended = true;
  const auto is_passing = [](const Warning &one) // another load step may reach it
  { return one.kind == WarningKind::no_contact; };
  report.warnings.erase(std::remove_if(report.warnings.begin(), report.warnings.end(), is_passing),
                        report.warnings.end());
  add_warnings(report);
  keep_worst(finished.warnings, report.warnings, place());
  if (finished.load.is_last)
    report.warnings = finished.warnings;
}

/** Is there no load step after the one that has ended? */
template <int dim>
bool LoadHistory<dim>::Evolution::is_over() const
{
  const Loading<dim> &loading = scene.loading;
  if (finished.load.number % loading.steps != 0)
    return false;
  const std::vector<LoadCycle> &cycles = finished.so_far.cycles;
  return loading.until_steady == 0 || cycles.size() >= loading.maximum_cycles ||
         are_steady(cycles, loading.until_steady);
}

/** At the end of a cycle, what it did. */
template <int dim>
void LoadHistory<dim>::Evolution::count_cycle()
{
  const LoadStep &load = finished.load;
  if (load.cycle == 0 || load.number % scene.loading.steps != 0)
    return;
  LoadCycle cycle{load.number, load.work, load.dissipated, std::numeric_limits<double>::infinity()};
  std::vector<LoadCycle> &cycles = finished.so_far.cycles;
  for (const LoadCycle &before : cycles)
  {
    cycle.work -= before.work;
    cycle.dissipated -= before.dissipated;
  }
  if (!cycles.empty())
  {
    const double larger = std::max(cycle.dissipated, cycles.back().dissipated);
    cycle.change = larger <= 1e-12 * (std::abs(load.work) + load.stored)
                       ? 0.
                       : std::abs(cycle.dissipated - cycles.back().dissipated) / larger;
  }
  cycles.push_back(cycle);
}

/** Takes the place of @p largest where it is larger. */
template <int dim>
void LoadHistory<dim>::Evolution::count_largest(const StepReport<dim> &report)
{
  const auto compare = [&](HistoryLargest &largest, const double value, const Point<dim> &x,
                           const unsigned int boundary)
  {
    if (!(value > largest.value))
      return;
    largest = {value, {}, boundary, finished.load.number, finished.load.t};
    for (unsigned int d = 0; d < dim; ++d)
      largest.where[d] = x[d];
  };
  HistorySoFar &so_far = finished.so_far;
  for (const ContactState<dim> &state : report.contact)
  {
    compare(so_far.pressure, state.highest_pressure, state.highest_pressure_point, state.boundary);
    if (scene.boundaries[state.boundary].is_unilateral())
      for (const ContactPoint<dim> &point : state.points)
        compare(so_far.opening, std::min(point.gap, -point.normal_jump), point.x, state.boundary);
  }
  for (const StressSample<dim> &stress : report.extrema)
    if (stress.boundary == numbers::invalid_boundary_id)
      compare(so_far.von_mises, stress.value, stress.where, stress.boundary);
}

template <int dim>
void LoadHistory<dim>::Evolution::count(const Work &done)
{
  finished.load.work += scene.thickness * done.external;
  finished.load.dissipated += scene.thickness * done.dissipated;
  finished.load.released += scene.thickness * done.released;
  finished.load.unbalanced += scene.thickness * done.unbalanced;
  finished.load.trapezoidal += scene.thickness * done.trapezoidal;
  const double initial = scene.thickness * done.initial;
  finished.load.work += initial - finished.initial_part; // what heats the body does work on it, too
  finished.initial_part = initial;
}

/** What the load step did from where the one before has ended. */
template <int dim>
void LoadHistory<dim>::Evolution::count_work(const ReducedPart<dim> &part)
{
  if constexpr (dim == 2)
  {
    const Solution<dim> &solution = part.solution;
    const Vector<double> &loads = part.system.loads();
    const Work done = past ? work(interpolate(past->solution, *solution.spaces), solution, loads)
                           : work_from_rest(solution, loads);
    count(done);
    past.emplace(Past<dim>{current, solution});
  }
}

/** As in "load step 3, t = 0.15", for messages. */
template <int dim>
std::string LoadHistory<dim>::Evolution::place() const
{
  return "load step " + std::to_string(finished.load.number) +
         ", t = " + to_string(finished.load.t);
}

template <int dim>
LoadHistory<dim>::LoadHistory(const Scene<dim> &scene, MPI_Comm communicator)
    : evolution(std::make_unique<Evolution>(scene, communicator))
{
}

template <int dim>
LoadHistory<dim>::LoadHistory(const Scene<dim> &scene, const RunState<dim> &state,
                              MPI_Comm communicator)
    : evolution(std::make_unique<Evolution>(scene, state, communicator))
{
}

template <int dim>
LoadHistory<dim>::~LoadHistory() = default;

template <int dim>
std::optional<RunState<dim>> LoadHistory<dim>::state() const
{
  if (!evolution->scene.has_load_history())
    return evolution->solver->state();
  if (!evolution->has_ended)
    return std::nullopt;
  return evolution->solver->state(evolution->finished);
}

template <int dim>
void LoadHistory<dim>::prepare(const std::function<void(const Progress &)> &on_stage)
{
  try
  {
    evolution->solver->prepare(on_stage);
  }
  catch (const NumericalFailure &)
  {
  }
}

template <int dim>
void LoadHistory<dim>::run(const std::function<void(const StepReport<dim> &)> &finished_step,
                           const std::function<void(const Progress &)> &on_stage)
{
  if (!evolution->scene.has_load_history())
  {
    evolution->solver->run(finished_step, on_stage);
    return;
  }
  const auto take = [&](const StepReport<dim> &step)
  {
    StepReport<dim> report = evolution->report(step);
    if (!step.stopped_by.empty())
      evolution->conclude(report);
    finished_step(report);
  };
  const auto announce = [&](const Progress &progress)
  {
    on_stage({progress.step + evolution->finished.n_steps,
              evolution->place() + ": " + progress.stage, progress.note});
  };
  try
  {
    for (;;)
    {
      evolution->solver->run(take, announce);
      if (evolution->is_over())
        return;
      evolution->begin(evolution->finished.load.number + 1);
    }
  }
  catch (const MemoryFailure &failure)
  {
    throw MemoryFailure(evolution->place() + ": " + failure.what());
  }
  catch (const NumericalFailure &failure)
  {
    throw NumericalFailure(evolution->place() + ": " + failure.what());
  }
  catch (const InputError &error)
  {
    throw error.names_time
        ? error
        : InputError(std::string(error.what()) + " (" + evolution->place() + ")", true);
  }
}

template class LoadHistory<2>;
template class LoadHistory<3>;
} // namespace hpvi
