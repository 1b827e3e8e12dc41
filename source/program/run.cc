// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/output/contact_report.h>
#include <hpvi/output/output.h>
#include <hpvi/output/results_report.h>
#include <hpvi/output/scene_words.h>
#include <hpvi/plane/matching.h>
#include <hpvi/program/failure.h>
#include <hpvi/program/interruption.h>
#include <hpvi/program/run.h>
#include <hpvi/program/started_processes.h>
#include <hpvi/program/terminal.h>
#include <hpvi/reader/scene_reader.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

namespace hpvi
{
namespace
{
/** A load history in the plane may have one in each load step. */
template <int dim>
bool has_bound_column(const Scene<dim> &scene, const bool is_primal)
{
  return (!is_primal || dim == 3) && scene.error_bound &&
         ((dim == 2 && scene.has_load_history()) || no_error_bound(scene).empty());
}

/** The true error has a column only where there is something to compare with, time in a history. */
template <int dim>
void print_table_head(const Scene<dim> &scene, const bool is_primal)
{
  std::cout << "errors in parts of the solution, by energy norms: indicator (guarantees nothing)"
            << (!has_bound_column(scene, is_primal) ? ""
                : scene.has_coulomb_friction()      ? ", bound (if the coupling is as estimated)"
                                                    : ", bound (guaranteed)")
            << (scene.has_known_solution() ? ", true_error" : "") << '\n'
            << "step  elements  dofs_free multipliers  p  indicator"
            << (has_bound_column(scene, is_primal) ? "     bound" : "")
            << (scene.has_known_solution() ? "  true_error" : "")
            << (is_primal ? "       slack  newton  cg_steps   seconds"
                          : "       slack qp_products   seconds")
            << (scene.has_load_history() ? " load_step       t" : "") << std::endl;
}

/** A number with @p digits, or where it says nothing "-". */
std::string shown(const double value, const bool says_something, const int digits)
{
  std::ostringstream out;
  out << std::scientific << std::setprecision(digits) << value;
  return says_something ? out.str() : "-";
}

template <int dim>
void print_row(const StepReport<dim> &step)
{
  // Of a body that moves and is not yet deformed the indicator is thousands of times the solution.
  constexpr double nothing = 100, round_off = 1e-14;

  const bool is_primal = bool(step.primal);
  std::ostringstream degrees;
  degrees << step.size.p_min();
  if (!is_primal)
    degrees << '-' << step.size.p_max();
  std::cout << std::setw(4) << step.number << std::setw(10) << step.size.n_cells << std::setw(11)
            << step.size.n_free << std::setw(is_primal ? 12 : 10) << step.size.n_multipliers
            << std::setw(is_primal ? 3 : 6) << degrees.str() << std::setw(is_primal ? 11 : 10)
            << shown(step.relative_estimate, step.relative_estimate < nothing, 1);
  if (has_bound_column(step.scene, is_primal))
    std::cout << std::setw(10)
              << shown(step.relative_bound, step.bound && step.relative_bound < nothing, 1);
  if (step.scene.has_known_solution())
    std::cout << std::setw(12)
              << shown(step.errors.energy / step.errors.energy_norm,
                       std::isfinite(step.errors.energy / step.errors.energy_norm), 3);
  std::cout << std::setw(12)
            << shown(step.energies.slack,
                     std::abs(step.energies.slack) >
                         round_off * step.energies.norm * step.energies.norm,
                     3);
  if (is_primal)
    std::cout << std::setw(8) << step.primal->newton.steps + step.primal->newton.augmented_steps
              << std::setw(10) << step.primal->newton.cg_steps;
  else
    std::cout << std::setw(12) << step.reduced->qp.multiplications;
  std::cout << std::fixed << std::setprecision(2) << std::setw(10) << step.seconds;
  if (step.load.number > 0)
    std::cout << std::setw(10) << step.load.number << std::setprecision(4) << std::setw(8)
              << step.load.t;
  std::cout << std::endl;
}

/** What became of a history, nothing without one. */
std::string work_in_words(const LoadStep &load)
{
  if (load.number == 0)
    return {};
  return "load history: work " + text(load.work, 6) + ", stored " + text(load.stored, 6) +
         ", dissipated by friction " + text(load.dissipated, 6) + ", released " +
         text(load.released, 2) + ", unbalanced " + text(load.unbalanced, 2) + "\n";
}

/** Why the last step has no bound of its error, or no step has one, although the scene wants it, for itself or for a tolerance. */
template <int dim>
std::string missing_bound_in_words(const StepReport<dim> &step, const std::string &last_bound)
{
  const Adaptivity &limits = step.scene.adaptivity;
  const bool is_in_its_place = limits.tolerance > 0 && limits.tolerance_on == Indicator::bound &&
                               limits.tolerance_column.empty() &&
                               step.stopped_by.stop != Stop::round_off,
             is_wanted = step.scene.error_bound && (!step.primal || dim == 3);
  if (step.bound || step.no_bound.empty() || !(is_wanted || is_in_its_place))
    return {};
  const bool has_none = (dim == 3 || step.load.number == 0) && !no_error_bound(step.scene).empty();
  return "\nno bound of the error" + (has_none ? "" : " in step " + text(step.number)) + ": " +
         step.no_bound + (last_bound.empty() ? "" : "; " + last_bound) + "\n" +
         (is_in_its_place ? "Adaptivity/Tolerance was compared with the indicator in its place, "
                            "which guarantees nothing\n"
                          : "");
}

/** Where J(u_N) bounds the least energy from above alone. */
template <int dim>
std::string upper_end_in_words(const StepReport<dim> &step)
{
  if (step.bound || std::isnan(step.energy_high))
    return {};
  return "\nenergy: the least J(u) is at most " + text(step.energy_high) +
         ", that of u_N; its lower end is open, for there is no bound of the error\n";
}

/** How well forces balance, and what Newton's method has to do with it. */
template <int dim>
std::string balance_in_words(const StepReport<dim> &step)
{
  const double tolerance = step.scene.solver.primal_tolerance;
  std::string of_bodies;
  for (const BodyBalance &one : step.equilibrium.bodies)
    of_bodies += (of_bodies.empty() ? "balance of each body, the larger of both: " : ", ") +
                 one.body + " " + text(std::max(one.force_imbalance, one.moment_imbalance), 2);
  of_bodies += of_bodies.empty() ? "" : "\n";
  return "\nbalance: forces to " + text(step.equilibrium.force_imbalance, 2) + ", moments to " +
         text(step.equilibrium.moment_imbalance, 2) + " of their absolute sums" +
         (step.primal
              ? ";\n  Newton's method left " + text(step.primal->newton.residual, 2) +
                    " of the loads, for Solver/Primal tolerance = " + text(tolerance) +
                    (tolerance > 0 ? ""
                                   : ": enough beside the error of the mesh, 1e-10 balances them")
              : "") +
         "\n" + of_bodies;
}

/** Why a run is over: @p stopped_by as in StepReport, after a step with a bound of its error or without; @p by_coupling: one of Coulomb's law. */
std::string stop_reason(const StopReason &stopped_by, const Adaptivity &adaptivity,
                        const bool has_bound, const std::string &terms)
{
  const Stop stop = stopped_by.stop;
  if (stop == Stop::round_off)
    return "stopped: exact to round-off";
  if (stop == Stop::first_step)
    return "solved once, as Loading/Adapt = first step says";
  if (stop == Stop::tolerance && adaptivity.tolerance_column == equilibrated_estimate)
    return "done: the error, estimated by a stress in equilibrium, is below Adaptivity/Tolerance";
  if (stop == Stop::tolerance && !adaptivity.tolerance_column.empty())
    return "done: " + adaptivity.tolerance_column +
           (terms.empty() ? " is guaranteed" : ", " + terms + ", is known") +
           " to Adaptivity/Tolerance of its value";
  if (stop == Stop::tolerance && adaptivity.is_default_tolerance)
    return std::string("done: the error ") +
           (has_bound && !terms.empty() && adaptivity.tolerance_on == Indicator::bound
                ? "bound, " + terms + ", "
                : "") +
           (has_bound && adaptivity.tolerance_on == Indicator::bound ? "" : "indicator ") +
           "is below " + default_tolerance + ", the default of Adaptivity/Tolerance";
  return "stopped by " + std::string(stop == Stop::load_step ? "the " : "Adaptivity/") +
         text(stopped_by);
}

/** What a bound rests on; empty: nothing. */
std::string terms_of(const BoundKind kind)
{
  return kind == BoundKind::energy    ? ""
         : kind == BoundKind::history ? "for the computed history"
                                      : "if the coupling is as estimated";
}

/** What is said when the last step is over. */
struct Ending
{
  StageTimes times;
  std::vector<std::string> warnings;
  std::string words, reason;
  std::string last_bound; ///< of the last step that has one
  unsigned int load_steps = 0;

  template <int dim>
  void hear(const StepReport<dim> &step);
};

template <int dim>
void Ending::hear(const StepReport<dim> &step)
{
  load_steps = step.load.number;
  times += step.times;
  reason = stop_reason(step.stopped_by, step.scene.adaptivity, bool(step.bound),
                       step.bound ? terms_of(step.bound->kind) : "");
  warnings = texts(step.warnings);
  if (step.bound)
    last_bound = "that of step " + text(step.number) + " is " + text(step.relative_bound, 2) +
                 " of the solution";
  if (!step.contradiction.empty())
    last_bound.clear();
  if (!step.stopped_by.empty())
    words = contact_in_words(step) + results_in_words(step) + balance_in_words(step) +
            upper_end_in_words(step) + missing_bound_in_words(step, last_bound) +
            work_in_words(step.load);
}

/** A signal reaches processes at different times: they stop where the first one has noticed. */
void stop_all_if_interrupted()
{
  int signal = 0;
  try
  {
    stop_if_interrupted();
  }
  catch (const Interruption &interruption)
  {
    signal = interruption.signal;
  }
  if (signal = dealii::Utilities::MPI::max(signal, MPI_COMM_WORLD); signal != 0)
    throw Interruption(signal);
}

template <int dim>
void print_head(const Scene<dim> &scene, const Output<dim> &output, const std::string &directory,
                const std::string &loads, const unsigned int n_steps)
{
  const unsigned int n = n_started_processes();
  std::cout << version_line() << (n > 1 ? ", " + std::to_string(n) + " processes" : "") << '\n'
            << legible(scene.title) << '\n'
            << (n_steps == 0 ? replacement_in_words(output.replaced_scene(), directory)
                             : "goes on after step " + std::to_string(n_steps) + "\n")
            << '\n'
            << loads;
  for (const std::string &remark : scene.remarks)
    std::cout << remark << '\n';
  std::cout << std::endl;
}

template <int dim>
void print_end(const Scene<dim> &scene, const Ending &ending, const std::string &directory)
{
  print_stages(ending.times);
  std::cout << ending.words;
  for (const std::string &warning : ending.warnings)
    std::cout << "\nwarning: " << warning;
  std::cout << (ending.warnings.empty() ? "" : "\n") << '\n'
            << (scene.has_load_history()
                    ? std::to_string(ending.load_steps) + " load steps; the last "
                    : "")
            << ending.reason << "\nresults in " << directory << "\nreport: hpvi --report "
            << directory << std::endl;
  check_standard_output("; the results in " + printable(directory) + " are complete");
}
/** @p state: where it goes on. */
template <int dim>
void solve(const std::optional<RunState<dim>> &state, const Scene<dim> &scene,
           const std::string &directory, const RunListener<dim> &listener)
{
  const auto solver = state ? std::make_unique<LoadHistory<dim>>(scene, *state, MPI_COMM_WORLD)
                            : std::make_unique<LoadHistory<dim>>(scene, MPI_COMM_WORLD);
  solver->prepare(listener.on_stage);
  Output<dim> output(scene, directory, state ? state->n_steps() : 0, MPI_COMM_WORLD);
  listener.begun(output);
  try
  {
    solver->run(
        [&](const StepReport<dim> &step)
        {
          listener.finished(step);
          output.write_step(step, solver.get());
        },
        listener.on_stage);
  }
  catch (const Interruption &interruption)
  {
    output.give_up(RunStatus::interrupted, interruption.what());
    throw Interruption(interruption.signal,
                       "; " + output.safe_steps() + " in " + printable(directory));
  }
  catch (const std::exception &error)
  {
    output.give_up(RunStatus::failed, failure_line(error)); // the finished steps stay
    throw;
  }
  output.finish();
}

template <int dim>
void run_from(const std::optional<RunState<dim>> &state, const Scene<dim> &scene,
              const std::string &directory)
{
  note_interruptions();
  const bool is_primal = takes_primal_path(scene, n_started_processes());
  const std::string loads = resultant_in_words(scene, is_primal);
  ProgressLine progress;
  Ending ending;
  const auto on_stage = [&](const Progress &stage)
  {
    stop_all_if_interrupted();
    progress.show(stage);
  };
  const auto begun = [&](const Output<dim> &output)
  {
    progress.erase();
    print_head(scene, output, directory, loads, state ? state->n_steps() : 0);
    print_table_head(scene, is_primal);
  };
  const auto finished = [&](const StepReport<dim> &step)
  {
    progress.erase();
    print_row(step);
    ending.hear(step);
  };
  solve<dim>(state, scene, directory, {on_stage, begun, finished});
  progress.erase();
  print_end(scene, ending, directory);
}

} // namespace

template <int dim>
void run_silently(const Scene<dim> &scene, const std::string &directory,
                  const RunListener<dim> &listener)
{
  solve<dim>(std::nullopt, scene, directory, listener);
}

template <int dim>
void run(const Scene<dim> &scene, const std::string &directory)
{
  run_from<dim>(std::nullopt, scene, directory);
}

template <int dim>
void resume(const Scene<dim> &scene, const std::string &directory)
{
  std::optional<RunState<dim>> state;
  in_all_processes(
      [&]()
      {
        const std::string file = directory + "/state.dat";
        std::ifstream in(file, std::ios::binary);
        if (!in)
          throw InputError("hpvi: --resume " + printable(directory, 400) +
                           ": has no state.dat, for no step was finished there, no load step of a "
                           "load history; begin the run anew");
        state = RunState<dim>::read(in, file);
      });
  run_from(state, scene, directory);
}

template void run_silently(const Scene<2> &, const std::string &, const RunListener<2> &);
template void run_silently(const Scene<3> &, const std::string &, const RunListener<3> &);
template void resume(const Scene<2> &, const std::string &);
template void resume(const Scene<3> &, const std::string &);
template void run(const Scene<2> &, const std::string &);
template void run(const Scene<3> &, const std::string &);
} // namespace hpvi
