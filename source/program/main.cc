// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>
#include <hpvi/adaptivity/load_history.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/text.h>
#include <hpvi/evaluation/inf_sup.h>
#include <hpvi/input/parameters.h>
#include <hpvi/output/contact_report.h>
#include <hpvi/output/output.h>
#include <hpvi/program/command_line.h>
#include <hpvi/program/interruption.h>
#include <hpvi/program/primal_run.h>
#include <hpvi/program/terminal.h>
#include <hpvi/scene/scene_reader.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <sstream>

// Present where OpenBLAS is the BLAS in use.
extern "C" int openblas_get_num_threads() __attribute__((weak));

namespace
{
using namespace hpvi;

constexpr int dim = 2;

bool is_foreseen(const std::exception &error)
{
  return dynamic_cast<const InputError *>(&error) ||
         dynamic_cast<const NumericalFailure *>(&error) ||
         dynamic_cast<const OutputFailure *>(&error) || dynamic_cast<const Interruption *>(&error);
}

/** The one line for stderr. */
std::string failure_line(const std::exception &error)
{
  if (dynamic_cast<const std::bad_alloc *>(&error) ||
      dynamic_cast<const dealii::StandardExceptions::ExcOutOfMemory *>(&error))
    return "hpvi: out of memory; lower Adaptivity/Maximum unknowns, take fewer "
           "Geometry/Subdivisions or allow more memory";
  return (is_foreseen(error) ? "" : "hpvi: internal error: ") + one_line(error);
}

int exit_status(const std::exception &error)
{
  if (const auto *interruption = dynamic_cast<const Interruption *>(&error))
    return 128 + interruption->signal;
  return dynamic_cast<const InputError *>(&error) ? 1 : 2;
}

/**
 * A standard stream that is closed gets a descriptor that cannot be written: else the first file of
 * results would take its number, and the text meant for the stream.
 */
void occupy_standard_streams()
{
  int descriptor;
  do
    descriptor = open("/dev/null", O_RDONLY | O_CLOEXEC);
  while (descriptor >= 0 && descriptor <= STDERR_FILENO);
  if (descriptor > STDERR_FILENO)
    close(descriptor);
}

// ---------------------------------------------------------------- what a run prints

/** A load history has one for its first load step. */
bool has_bound_column(const Scene<dim> &scene)
{
  return scene.error_bound && (scene.has_load_history() || scene.no_error_bound().empty());
}

/** The true error has a column only where there is something to compare with, time in a history. */
void print_table_head(const Scene<dim> &scene)
{
  std::cout << "step  elements  dofs_free multipliers  p    estimate  relative"
            << (has_bound_column(scene) ? "     bound" : "")
            << (scene.has_known_solution() ? "  true_error" : "")
            << "       slack qp_products   seconds"
            << (scene.has_load_history() ? " load_step       t" : "") << std::endl;
}

void print_row(const StepReport<dim> &step)
{
  const DisplacementSpace<dim> &space = step.solution.displacement_space;
  const auto [p_min, p_max] = std::minmax_element(space.degrees().begin(), space.degrees().end());
  std::ostringstream degrees;
  degrees << *p_min << '-' << *p_max;
  std::cout << std::setw(4) << step.number << std::setw(10) << space.degrees().size()
            << std::setw(11) << space.n_free_dofs() << std::setw(10)
            << step.solution.contact_space.n_multipliers() << std::setw(6) << degrees.str()
            << std::scientific << std::setprecision(3) << std::setw(11) << step.estimate.total()
            << std::setprecision(1) << std::setw(10) << step.relative_estimate;
  if (step.bound)
    std::cout << std::setw(10) << step.relative_bound;
  else if (has_bound_column(step.solution.scene))
    std::cout << std::setw(10) << "-";
  if (!std::isnan(step.errors.energy))
    std::cout << std::setprecision(3) << std::setw(12) << step.errors.energy;
  std::cout << std::setprecision(3) << std::setw(12) << step.energies.slack << std::setw(12)
            << step.qp.multiplications << std::fixed << std::setprecision(2) << std::setw(10)
            << step.seconds;
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

/** Why the last step has no bound of its error, where steps may have one; nothing else. */
std::string missing_bound_in_words(const StepReport<dim> &step, const std::string &last_bound)
{
  const Scene<dim> &scene = step.solution.scene;
  if (step.bound || !scene.error_bound || !scene.no_error_bound().empty())
    return {};
  return "\nno bound of the error in step " + text(step.number) + ": " + step.no_bound +
         (last_bound.empty() ? "" : "; " + last_bound) + "\n";
}

// ---------------------------------------------------------------- what the program does

/** What the first step may still reject comes before anything is written; where it fails, the run will say so. */
void prepare(LoadHistory<dim> &solver, const std::function<void(const Progress &)> &announce)
{
  try
  {
    solver.prepare(announce);
  }
  catch (const NumericalFailure &)
  {
  }
}

void run(const Scene<dim> &scene, const std::string &directory)
{
  note_interruptions();
  ProgressLine progress;
  const auto announce = [&](const Progress &stage)
  {
    stop_if_interrupted();
    progress.show(stage);
  };
  LoadHistory<dim> solver(scene);
  prepare(solver, announce);
  progress.erase();
  Output<dim> output(scene, directory);
  StageTimes times;
  std::vector<std::string> warnings;
  std::string closing_words, reason; ///< of the last step
  std::string last_bound;            ///< of the last one that has one
  std::cout << version_line() << '\n'
            << legible(scene.title) << '\n'
            << replacement_in_words(output.replaced_scene(), directory) << '\n'
            << loads_in_words(scene) << std::endl;
  print_table_head(scene);
  try
  {
    solver.run(
        [&](const StepReport<dim> &step)
        {
          progress.erase();
          print_row(step);
          times += step.times;
          reason = last_word(step.stopped_by, scene.adaptivity, bool(step.bound));
          warnings = step.warnings;
          if (step.bound)
            last_bound = "that of step " + text(step.number) + " is " +
                         text(step.relative_bound, 2) + " of the solution";
          if (!step.stopped_by.empty())
            closing_words =
                contact_in_words(scene, step.contact, step.equilibrium, step.unbounded) +
                "\nbalance: forces to " + text(step.equilibrium.force_imbalance, 2) +
                ", moments to " + text(step.equilibrium.moment_imbalance, 2) +
                " of their absolute sums\n" + missing_bound_in_words(step, last_bound) +
                work_in_words(step.load);
          output.write_step(step);
        },
        announce);
  }
  catch (const Interruption &interruption)
  {
    progress.erase();
    output.give_up("interrupted", interruption.what());
    throw Interruption(interruption.signal,
                       "; " + output.safe_steps() + " in " + printable(directory));
  }
  catch (const std::exception &error)
  {
    output.give_up("failed", failure_line(error)); // the finished steps stay
    throw;
  }
  output.finish();
  print_stages(times);
  std::cout << closing_words;
  for (const std::string &warning : warnings)
    std::cout << "\nwarning: " << warning;
  std::cout << (warnings.empty() ? "" : "\n") << '\n'
            << (scene.has_load_history()
                    ? std::to_string(scene.loading.steps) + " load steps; the last "
                    : "")
            << reason << "\nresults in " << directory << std::endl;
  check_standard_output("; the results in " + printable(directory) + " are complete");
}

void print_inf_sup_row(const StepReport<dim> &step, const InfSup &inf_sup)
{
  const DisplacementSpace<dim> &space = step.solution.displacement_space;
  std::cout << std::setw(4) << step.number << std::setw(10) << space.degrees().size()
            << std::setw(11) << space.n_free_dofs() << std::setw(12) << inf_sup.n_multipliers
            << std::setw(6) << inf_sup.lowest_degree << std::setw(6) << inf_sup.highest_degree
            << std::scientific << std::setprecision(6) << std::setw(14) << inf_sup.beta
            << std::setprecision(3) << std::setw(11) << inf_sup.bound() << std::endl;
}

/**
 * The scene whose run refines the mesh while another's multipliers are measured on it: itself, or
 * where no run could solve it the same scene with the stable multiplier, or the best its start
 * degree 1 allows.
 */
Scene<dim> refining_scene(const Scene<dim> &measured)
{
  Scene<dim> scene = measured;
  if (scene.solver.multiplier_offset >= 0)
    scene.solver.multiplier_offset = scene.adaptivity.start_degree < 2 ? -1 : -2;
  return scene;
}

/** As in p-2, p, p+1. */
std::string multiplier_degree(const int offset)
{
  return "p" + (offset == 0 ? "" : (offset > 0 ? "+" : "") + std::to_string(offset));
}

void print_inf_sup(const Scene<dim> &scene)
{
  if (!scene.has_friction() && !scene.has_unilateral_contact())
    throw InputError(scene.origin() +
                     ": Boundary left, right, bottom, top/Friction bound: no boundary "
                     "names one, so there is no multiplier to measure the inf-sup "
                     "constant of; name a contact with a bound, or a unilateral one, or remove "
                     "--inf-sup");
  const Scene<dim> refining = refining_scene(scene);
  AdaptiveSolver<dim> solver(refining);
  note_interruptions();
  std::cout << version_line() << '\n'
            << legible(scene.title) << "\n\n"
            << "multiplier degree " << multiplier_degree(scene.solver.multiplier_offset)
            << "; p_min and p_max on the contact boundary; "
            << "bound = 1/(p_max^1/2 log^3/2 p_max)\n\n"
            << "step  elements  dofs_free multipliers p_min p_max          beta      bound"
            << std::endl;
  ProgressLine progress;
  solver.run(
      [&](const StepReport<dim> &step)
      {
        progress.show({step.number, "measuring the inf-sup constant", ""});
        const DisplacementSpace<dim> &space = step.solution.displacement_space;
        const InfSup inf_sup = measure_inf_sup(scene, space.triangulation(), space.degrees());
        progress.erase();
        print_inf_sup_row(step, inf_sup);
      },
      [&](const Progress &stage)
      {
        stop_if_interrupted();
        progress.show(stage);
      });
}

/** Several processes decide the path, and what follows it: Normal contact. scene.prm says both. */
template <int dimension>
Scene<dimension> read_scene(const CommandLine &command_line)
{
  const auto read = [&](const auto &overrides)
  {
    return read_scene<dimension>(command_line.scene_file, overrides,
                                 command_line.inf_sup ? SceneUse::measure : SceneUse::solve);
  };
  Scene<dimension> scene = read(command_line.overrides);
  if (n_started_processes() == 1 || command_line.inf_sup ||
      scene.solver.path != SolutionPath::automatic)
    return scene;
  auto overrides = command_line.overrides;
  overrides.emplace_back("Solver/Path", "primal");
  return read(overrides);
}

/** @p start_mpi is called where several processes may share the work, and nowhere else: it takes its time. */
template <int dimension>
void obey_scene(const CommandLine &command_line, const std::function<void()> &start_mpi)
{
  std::optional<Scene<dimension>> read;
  agree([&]() { read.emplace(read_scene<dimension>(command_line)); });
  const Scene<dimension> &scene = *read;
  const std::string directory = command_line.output_directory.empty()
                                    ? "output/" + scene.name
                                    : command_line.output_directory;
  if (command_line.print_parameters)
    std::cout << scene.parameters->print(false);
  else if (command_line.validate)
    std::cout << scene.origin() << ": valid: " << legible(scene.title) << std::endl;
  else if (!command_line.inf_sup && takes_primal_path(scene))
  {
    start_mpi();
    run_primal(scene, directory);
  }
  else if constexpr (dimension == dim)
    command_line.inf_sup ? print_inf_sup(scene) : run(scene, directory);
}

bool is_in_space(const CommandLine &command_line)
{
  int dimension = 0;
  agree([&]() { dimension = scene_dimension(command_line.scene_file, command_line.overrides); });
  return dimension == 3;
}

void obey(const CommandLine &command_line, const std::function<void()> &start_mpi)
{
  if (command_line.help)
    std::cout << usage();
  else if (command_line.version)
    std::cout << version_line() << std::endl;
  else if (command_line.scene_file.empty())
    std::cout << default_parameters();
  else if (is_in_space(command_line))
    obey_scene<3>(command_line, start_mpi);
  else
    obey_scene<2>(command_line, start_mpi);
}

/**
 * OpenBLAS starts its threads when it is loaded. Each takes a buffer of 128 MB, tries for ever where
 * it gets none, and is waited for at the end. A run uses one thread alone: where memory is limited
 * the program begins again without the others.
 */
void do_without_threads_of_openblas(char *argv[])
{
  const std::string variable = "OPENBLAS_NUM_THREADS", none = "1";
  const char *const value = std::getenv(variable.c_str());
  if (!mapping_is_limited() || !openblas_get_num_threads || openblas_get_num_threads() == 1 ||
      (value && value == none))
    return;
  setenv(variable.c_str(), none.c_str(), 1);
  execv("/proc/self/exe", argv); // comes back only where it fails
}
/** One of several processes speaks for all. */
void be_silent()
{
  static std::ofstream nowhere("/dev/null");
  for (std::ostream *const stream : {&std::cout, &std::cerr})
    stream->rdbuf(nowhere.rdbuf());
}

/** What befalls one process alone leaves the others waiting for it: it ends them. */
void end_others(const std::exception &error)
{
  if (n_started_processes() == 1 || is_foreseen(error))
    return;
  std::fprintf(stderr, "%s\n", failure_line(error).c_str());
  MPI_Abort(MPI_COMM_WORLD, exit_status(error));
}
} // namespace

int main(int argc, char *argv[])
{
  do_without_threads_of_openblas(argv);
  occupy_standard_streams();
  survive_failed_writes();
  std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
  const auto start_mpi = [&]()
  {
    if (!mpi)
      mpi = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(argc, argv, 1);
  };
  if (may_have_company())
    start_mpi();
  if (!is_first_process())
    be_silent();
  try
  {
    obey(parse(argc, argv), start_mpi);
    check_standard_output("");
    return 0;
  }
  catch (const std::exception &error)
  {
    end_others(error);
    std::cerr << failure_line(error) << std::endl;
    return exit_status(error);
  }
}
