// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/output/primal_output.h>
#include <hpvi/primal/load_check.h>
#include <hpvi/program/interruption.h>
#include <hpvi/program/primal_run.h>
#include <hpvi/program/terminal.h>

#include <hpvi/checks/checks.h>

#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>

namespace hpvi
{
using namespace dealii;

namespace
{
bool is_mpi_running()
{
  int is_initialised = 0, is_finalised = 0;
  MPI_Initialized(&is_initialised);
  MPI_Finalized(&is_finalised);
  return is_initialised && !is_finalised;
}

void print_table_head()
{
  std::cout
      << "step  elements  dofs_free multipliers  p    estimate  relative       slack  newton  "
         "cg_steps   seconds"
      << std::endl;
}

template <int dim>
void print_row(const PrimalReport<dim> &step)
{
  std::cout << std::setw(4) << step.number << std::setw(10) << step.n_cells << std::setw(11)
            << step.space.n_free << std::setw(12) << step.space.n_multipliers() << std::setw(3)
            << step.space.tables.degree << std::scientific << std::setprecision(3) << std::setw(12)
            << step.total_estimate << std::setprecision(1) << std::setw(10)
            << step.relative_estimate << std::setprecision(3) << std::setw(12)
            << step.energies.slack << std::setw(8)
            << step.newton.steps + step.newton.augmented_steps << std::setw(10)
            << step.newton.cg_steps << std::fixed << std::setprecision(2) << std::setw(10)
            << step.seconds << std::endl;
}

/** Does the primal path offer what the scene asks for, the bound of the error included where a limit needs it? */
bool fits_primal_path(const Scene<2> &scene)
{
  if (scene.has_unilateral_contact() || // solved by nodes or multipliers, as the scene says
      (scene.adaptivity.tolerance > 0 && scene.adaptivity.tolerance_on == Indicator::bound))
    return false;
  try
  {
    check_primal_path(scene);
  }
  catch (const InputError &)
  {
    return false;
  }
  return true;
}

/**
 * Would the dense algebra of the first mesh take longer than what the primal path takes? Of one
 * core: `3e-10 s m^3` for m multipliers, and twelve times, for N unknowns,
 * `1e-6 s N + 3e-9 s N^3/2`. `./run space` measures all three, doc/space.md has the chart.
 */
bool primal_path_pays(const Scene<2> &scene)
{
  const double p = scene.adaptivity.start_degree;
  const auto &cells = scene.geometry.subdivisions;
  const double unknowns = 2 * (1 + p * cells[0]) * (1 + p * cells[1]);
  double multipliers = 0;
  for (const auto &boundary : scene.boundaries)
    if (boundary.has_contact() && boundary.friction.bound)
      multipliers += (p - 1) * cells[1 - boundary.id / 2];
  return fits_primal_path(scene) &&
         3e-10 * std::pow(multipliers, 3) > 12 * (1e-6 * unknowns + 3e-9 * std::pow(unknowns, 1.5));
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
  if (signal = Utilities::MPI::max(signal, MPI_COMM_WORLD); signal != 0)
    throw Interruption(signal);
}

/** What is said when the last step is over. */
struct Ending
{
  StageTimes times;
  std::string stopped_by;
  std::vector<std::string> warnings;
  std::string balance;
};

template <int dim>
void run_steps(const Scene<dim> &scene, PrimalSolver<dim> &solver, PrimalOutput<dim> &output,
               Ending &ending)
{
  ProgressLine progress;
  solver.run(
      [&](const PrimalReport<dim> &step)
      {
        progress.erase();
        print_row(step);
        ending.times += step.times;
        ending.stopped_by = step.stopped_by;
        ending.warnings = step.warnings;
        ending.balance =
            "\nbalance: forces to " + text(step.equilibrium.force_imbalance, 2) + ", moments to " +
            text(step.equilibrium.moment_imbalance, 2) +
            " of their absolute sums;\n  Newton's method left " + text(step.newton.residual, 2) +
            " of the loads, for Solver/Primal tolerance = " + text(scene.solver.primal_tolerance) +
            (scene.solver.primal_tolerance > 0
                 ? ""
                 : ": enough beside the error of the mesh, 1e-10 balances them") +
            "\n";
        output.write_step(step);
      },
      [&](const Progress &stage)
      {
        stop_all_if_interrupted();
        progress.show(stage);
      });
}
} // namespace

bool may_have_company()
{
  for (const char *const variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) // Open MPI, MPICH
    if (const char *const value = std::getenv(variable))
      return std::atoi(value) > 1;
  return false;
}

unsigned int n_started_processes()
{
  return is_mpi_running() ? Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) : 1;
}

bool is_first_process()
{
  return !is_mpi_running() || Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
}

void agree(const std::function<void()> &work)
{
  is_mpi_running() ? together(MPI_COMM_WORLD, work) : work();
}

template <int dim>
bool takes_primal_path(const Scene<dim> &scene)
{
  if (scene.solver.path == SolutionPath::reduced && n_started_processes() > 1)
    throw InputError(
        printable(scene.origin(), 400) + ": Solver/Path = reduced: works on one process, and " +
        std::to_string(n_started_processes()) + " were started; start one or set Path = primal");
  if constexpr (dim == 2)
    if (scene.solver.path == SolutionPath::automatic && primal_path_pays(scene))
      return true;
  return dim == 3 || scene.solver.path == SolutionPath::primal || n_started_processes() > 1;
}

template <int dim>
void run_primal(const Scene<dim> &scene, const std::string &directory)
{
  PrimalSolver<dim> solver(scene, MPI_COMM_WORLD); // first: it may still reject the mesh
  const LoadCheck<dim> loads(scene);               // and this a load
  note_interruptions();
  PrimalOutput<dim> output(scene, directory, MPI_COMM_WORLD);
  Ending ending;
  const unsigned int n = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  std::cout << version_line() << (n > 1 ? ", " + std::to_string(n) + " processes" : "") << '\n'
            << legible(scene.title) << '\n'
            << replacement_in_words(output.replaced_scene(), directory) << '\n'
            << loads.in_words() << std::endl;
  print_table_head();
  try
  {
    run_steps(scene, solver, output, ending);
  }
  catch (const Interruption &interruption)
  {
    output.give_up("interrupted", interruption.what());
    throw Interruption(interruption.signal,
                       "; " + output.safe_steps() + " in " + printable(directory));
  }
  catch (const std::exception &error)
  {
    output.give_up("failed", one_line(error)); // the finished steps stay
    throw;
  }
  output.finish();
  print_stages(ending.times);
  std::cout << ending.balance;
  for (const std::string &warning : ending.warnings)
    std::cout << "\nwarning: " << warning;
  std::cout << (ending.warnings.empty() ? "" : "\n") << '\n'
            << last_word(ending.stopped_by, scene.adaptivity, /*has_bound=*/false)
            << "\nresults in " << directory << std::endl;
  check_standard_output("; the results in " + printable(directory) + " are complete");
}

template bool takes_primal_path(const Scene<2> &);
template bool takes_primal_path(const Scene<3> &);
template void run_primal(const Scene<2> &, const std::string &);
template void run_primal(const Scene<3> &, const std::string &);
} // namespace hpvi
