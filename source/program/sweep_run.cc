// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/cores.h>
#include <hpvi/base/file_format.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/one_thread.h>
#include <hpvi/base/text.h>
#include <hpvi/driver/backend.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/output/output.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/output/scene_words.h>
#include <hpvi/output/summary.h>
#include <hpvi/program/interruption.h>
#include <hpvi/program/started_processes.h>
#include <hpvi/program/sweep_run.h>
#include <hpvi/program/swept_run.h>
#include <hpvi/program/terminal.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/scene_reader.h>

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <optional>

namespace hpvi
{
namespace
{
using Clock = std::chrono::steady_clock;

double seconds_since(const Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/** The scenes of one command, and what becomes of them. */
template <int dim>
class Sweep
{
public:
  explicit Sweep(const CommandLine &command_line);

  void say_what_is_read() const; ///< for --validate and --print-parameters
  void solve(const std::function<void()> &start_mpi);

private:
  void naming_values(unsigned int k, const std::function<void()> &work) const;
  void read();
  void prepare(const std::vector<unsigned int> &numbers) const;
  void look_for_results();
  void solve_one(unsigned int k, bool is_alone);
  void solve_all(const std::vector<unsigned int> &numbers, unsigned int n_at_once);
  void finish(unsigned int k);
  void write_table();
  void print_head(std::size_t n_in_turn) const;
  void conclude();
  std::string directory_of(unsigned int k) const;
  Record last_row_of(unsigned int k) const;
  unsigned int count(RunStatus status) const;

  const Clock::time_point start = Clock::now();
  const CommandLine &command_line;
  const std::vector<SweptScene> swept;
  const unsigned int
      n_threads;    ///< 1 where mapping is limited, for each maps much more than it uses
  std::string home; ///< directory of all
  std::vector<std::optional<Scene<dim>>> scenes;
  std::vector<SweptRun> runs;
  std::vector<Record> last_rows;
  std::optional<ResultDirectory> directory;
  std::size_t width;                   ///< of the longest name
  std::mutex mutex;                    ///< of what follows, of runs and standard output
  std::vector<unsigned int> postponed; ///< short of memory beside others
  Clock::time_point written;           ///< the table
};

template <int dim>
Sweep<dim>::Sweep(const CommandLine &command_line)
    : command_line(command_line), swept(swept_scenes(command_line.sweeps)),
      n_threads(mapping_is_limited() ? 1 : n_usable_cores()), scenes(swept.size()),
      runs(swept.size()), last_rows(swept.size()), width(0)
{
  for (const SweptScene &scene : swept)
    width = std::max(width, scene.directory.size());
  read();
  home = command_line.output_directory.empty() ? "output/" + scenes.front()->name
                                               : command_line.output_directory;
}

/** Does @p work with scene k; where that is refused, the line begins with the values. */
template <int dim>
void Sweep<dim>::naming_values(const unsigned int k, const std::function<void()> &work) const
{
  try
  {
    work();
  }
  catch (const InputError &error)
  {
    throw InputError("hpvi: --sweep " + swept[k].words() + ": " + error.what());
  }
}

/** All of them, before anything is solved. */
template <int dim>
void Sweep<dim>::read()
{
  const auto read_one = [&](const unsigned int k)
  {
    auto overrides = command_line.overrides;
    overrides.insert(overrides.end(), swept[k].overrides.begin(), swept[k].overrides.end());
    scenes[k].emplace(read_scene<dim>(command_line.scene_file, overrides, SceneUse::solve));
    scenes[k]->solver.threads = 1;                                    // a core for each scene
    resultant_in_words(*scenes[k], takes_primal_path(*scenes[k], 1)); // refuses loads, too
  };
  on_threads(n_threads, swept.size(),
             [&](const unsigned int k) { naming_values(k, [&]() { read_one(k); }); });
}

/** What their first step refuses comes before anything is solved, too; whatever else goes wrong will do so again. */
template <int dim>
void Sweep<dim>::prepare(const std::vector<unsigned int> &numbers) const
{
  const auto prepare_one = [&](const unsigned int k)
  {
    try
    {
      LoadHistory<dim>(*scenes[k]).prepare();
    }
    catch (const InputError &)
    {
      throw;
    }
    catch (const std::exception &)
    {
    }
    forget_memory_claim();
  };
  on_threads(n_threads, numbers.size(),
             [&](const unsigned int number)
             {
               const unsigned int k = numbers[number];
               naming_values(k, [&]() { prepare_one(k); });
             });
}

template <int dim>
void Sweep<dim>::say_what_is_read() const
{
  for (std::size_t k = 0; k < swept.size(); ++k)
    if (command_line.print_parameters)
      std::cout << "# " << swept[k].words() << '\n' << scenes[k]->parameters->print(false) << '\n';
    else
      std::cout << swept[k].directory << ": valid: " << swept[k].words() << '\n';
}

template <int dim>
std::string Sweep<dim>::directory_of(const unsigned int k) const
{
  return home + "/" + swept[k].directory;
}

template <int dim>
Record Sweep<dim>::last_row_of(const unsigned int k) const
{
  const std::vector<Record> rows = records(content_of(directory_of(k) + "/convergence.csv"));
  return rows.empty() ? Record() : rows.back();
}

/** Which of them are done? Throws InputError where there is something else. */
template <int dim>
void Sweep<dim>::look_for_results()
{
  const auto reject = [&](const std::string &problem)
  {
    throw InputError("output directory '" + printable(home, 400) + "' cannot be used: " + problem +
                     "; choose another one with --output");
  };
  std::vector<std::string> names;
  for (const SweptScene &scene : swept)
    names.push_back(scene.directory);
  if (const std::string table = content_of(home + "/sweep.csv"); !table.empty())
  {
    const std::vector<Record> others = records(table);
    if (others.empty() || words_of(others.front(), "directory").empty())
      reject("its sweep.csv is no table of a sweep of hpvi, and would be overwritten");
    for (const Record &row : others)
      if (const std::string other = words_of(row, "directory");
          std::find(names.begin(), names.end(), other) == names.end())
        reject("its sweep.csv is of another sweep, with " + printable(other));
  }
  for (std::size_t k = 0; k < swept.size(); ++k)
  {
    const std::string scene = content_of(directory_of(k) + "/scene.prm");
    if (!scene.empty() && scene != effective_parameters(*scenes[k]))
      reject("its " + printable(swept[k].directory) + " has results of another scene");
    runs[k].was_done = !scene.empty() && is_complete_run(directory_of(k));
    if (!runs[k].was_done)
      continue;
    if (input_files_of(directory_of(k)) != input_files_of(*scenes[k]))
      reject("its " + printable(swept[k].directory) +
             " has results of a mesh file or a reference solution that has changed");
    runs[k].status = RunStatus::done;
    last_rows[k] = last_row_of(k);
  }
}

/** With the mutex held, or alone. */
template <int dim>
void Sweep<dim>::write_table()
{
  std::vector<Record> rows;
  for (std::size_t k = 0; k < swept.size(); ++k)
  {
    rows.emplace_back(swept[k].overrides.begin(), swept[k].overrides.end());
    rows.back().emplace_back("directory", swept[k].directory);
    rows.back().emplace_back("status", text(runs[k].status));
    rows.back().insert(rows.back().end(), last_rows[k].begin(), last_rows[k].end());
  }
  if (const std::error_code error = directory->write("sweep.csv", csv(rows)))
    throw OutputFailure(directory->name() + ": sweep.csv cannot be written: " + error.message());
  written = Clock::now();
}

/** The table once a second, for thousands of rows take their time. */
template <int dim>
void Sweep<dim>::finish(const unsigned int k)
{
  if (runs[k].status != RunStatus::refused) // else what is there is of an earlier run
    last_rows[k] = last_row_of(k);
  std::cout << runs[k].line(swept[k].directory, width, last_rows[k]) << std::endl;
  if (seconds_since(written) > 1)
    write_table();
}

template <int dim>
void Sweep<dim>::solve_one(const unsigned int k, const bool is_alone)
{
  if (interrupting_signal() != 0)
    return;
  SweptRun run = SweptRun::solved(*scenes[k], directory_of(k));
  const std::lock_guard<std::mutex> lock(mutex);
  run.was_postponed = runs[k].is_short_of_memory;
  runs[k] = run;
  if (run.is_short_of_memory && !is_alone)
    postponed.push_back(k);
  else
    finish(k);
}

template <int dim>
void Sweep<dim>::solve_all(const std::vector<unsigned int> &numbers, const unsigned int n_at_once)
{
  on_threads(n_at_once, numbers.size(),
             [&](const unsigned int k) { solve_one(numbers[k], n_at_once == 1); });
}

template <int dim>
void Sweep<dim>::print_head(const std::size_t n_in_turn) const
{
  std::cout << version_line() << '\n'
            << legible(scenes.front()->title) << '\n'
            << swept.size() << (swept.size() == 1 ? " scene" : " scenes") << " on " << n_threads
            << (n_threads == 1 ? " core" : " cores")
            << (mapping_is_limited() ? ", for ulimit says how much memory may be mapped" : "")
            << (n_in_turn > 0
                    ? "; " + std::to_string(n_in_turn) + " on the primal path, one after the other"
                    : "")
            << "\n\n"
            << SweptRun::head(width) << std::endl;
  for (std::size_t k = 0; k < swept.size(); ++k)
    if (runs[k].was_done)
      std::cout << runs[k].line(swept[k].directory, width, last_rows[k]) << std::endl;
}

template <int dim>
unsigned int Sweep<dim>::count(const RunStatus status) const
{
  return std::count_if(runs.begin(), runs.end(),
                       [&](const SweptRun &run) { return run.status == status; });
}

/** Throws where not all are done. */
template <int dim>
void Sweep<dim>::conclude()
{
  write_table();
  const std::string done =
      std::to_string(count(RunStatus::done)) + " of " + std::to_string(swept.size()) +
      (swept.size() == 1 ? " scene is" : " scenes are") + " done in " + printable(home, 400);
  if (const int signal = interrupting_signal(); signal != 0)
    throw Interruption(signal, "; " + done + ", and the same command goes on with the others");
  double sum = 0;
  for (const SweptRun &run : runs)
    sum += run.seconds;
  std::cout << std::fixed << std::setprecision(2) << '\n'
            << done << ": " << seconds_since(start) << " s, the sum of their own is " << sum
            << " s\na row for each in " << home << "/sweep.csv" << std::endl;
  check_standard_output("; the results in " + printable(home, 400) + " are complete");
  const std::string others = ", and sweep.csv says which";
  if (const unsigned int n = count(RunStatus::failed))
    throw NumericalFailure("hpvi: " + std::to_string(n) + " of " + std::to_string(swept.size()) +
                           " scenes failed; " + done + others);
  if (const unsigned int n = count(RunStatus::refused))
    throw InputError("hpvi: " + std::to_string(n) + " of " + std::to_string(swept.size()) +
                     " scenes were refused; " + done + others);
}

template <int dim>
void Sweep<dim>::solve(const std::function<void()> &start_mpi)
{
  // Dense algebra has one number of threads for the process. That of deal.II stays: with one it
  // takes another way to the stresses of solution-NN.vtu, whose last bits would not be those of a
  // run alone.
  const OneThread one_thread;
  look_for_results();
  std::vector<unsigned int> together, in_turn;
  for (std::size_t k = 0; k < swept.size(); ++k)
    if (!runs[k].was_done)
      (takes_primal_path(*scenes[k], 1) ? in_turn : together).push_back(k);
  prepare(together);
  directory.emplace(home, "", std::vector<std::string>());
  note_interruptions();
  print_head(in_turn.size());
  write_table();
  solve_all(together, n_threads);
  solve_all(std::vector<unsigned int>(postponed), 1);
  if (!in_turn.empty())
    start_mpi();
  note_interruptions(); // MPI has its own ways with signals when it starts
  solve_all(in_turn, 1);
  conclude();
}
} // namespace

template <int dim>
void sweep(const CommandLine &command_line, const std::function<void()> &start_mpi)
{
  if (n_started_processes() > 1)
    throw InputError("hpvi: --sweep " + printable(command_line.sweeps.front().path) +
                     ": solves scenes on the cores of one process; start it as one process");
  Sweep<dim> all(command_line);
  if (command_line.validate || command_line.print_parameters)
    all.say_what_is_read();
  else
    all.solve(start_mpi);
}

template void sweep<2>(const CommandLine &, const std::function<void()> &);
template void sweep<3>(const CommandLine &, const std::function<void()> &);
} // namespace hpvi
