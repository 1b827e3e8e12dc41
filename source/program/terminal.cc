// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/base/version.h>
#include <hpvi/output/output.h>
#include <hpvi/program/started_processes.h>
#include <hpvi/program/terminal.h>

#include <deal.II/base/config.h>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <iostream>

namespace hpvi
{
std::string version_line()
{
  return "hpvi " + version() + " (" + build_type() + " build), deal.II " DEAL_II_PACKAGE_VERSION;
}

std::string replacement_in_words(const std::string &scene_file, const std::string &directory)
{
  if (scene_file.empty())
    return {};
  return "note: replaces the results of " + printable(scene_file, 400) + " in " +
         printable(directory, 400) + "\n";
}

void check_standard_output(const std::string &complete)
{
  if (!std::cout.flush())
    throw OutputFailure("hpvi: standard output cannot be written" + complete);
}

namespace
{
void print_stage(const std::string &name, const double seconds, const double total)
{
  std::cout << std::left << std::setw(10) << name << std::right << std::setprecision(3)
            << std::setw(10) << seconds << std::setprecision(1) << std::setw(9)
            << (total > 0 ? 100 * seconds / total : 0.) << '\n';
}

} // namespace

void print_stages(const StageTimes &times)
{
  const double total = times.total();
  std::cout << "\nstage        seconds  percent\n" << std::fixed;
  for (const auto &[name, seconds] : times.named())
    print_stage(name, seconds, total);
  print_stage("total", total, total);
}

/** mpirun gives its first process a terminal whether it has one or not: there ./run says so. */
ProgressLine::ProgressLine()
    : is_terminal(isatty(STDOUT_FILENO) &&
                  (n_started_processes() == 1 || std::getenv("HPVI_TERMINAL") != nullptr))
{
}

ProgressLine::~ProgressLine()
{
  erase();
}

/**
 * A stage whose numbers alone change is shown ten times a second. As long as mpirun waits for the end of its
 * processes it reads nothing: one that wrote more than a terminal holds would never come to its end.
 */
void ProgressLine::show(const Progress &progress)
{
  const auto now = std::chrono::steady_clock::now();
  std::string next = progress.stage;
  next.erase(
      std::remove_if(next.begin(), next.end(), [](const char c) { return '0' <= c && c <= '9'; }),
      next.end());
  if (shown && next == words && now - since < std::chrono::milliseconds(100))
    return;
  words = next;
  since = now;
  erase();
  if (!progress.note.empty() && !noted)
    std::cout << "note: " << progress.note << std::endl;
  noted = noted || !progress.note.empty();
  if (is_terminal)
    std::cout << "step " << progress.step << ": " << progress.stage << " ..." << std::flush;
  shown = is_terminal;
}

void ProgressLine::erase()
{
  const char *const return_and_clear = "\r\033[K";
  if (shown)
    std::cout << return_and_clear << std::flush;
  shown = false;
}
} // namespace hpvi
