// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/input_error.h>
#include <hpvi/base/memory.h>
#include <hpvi/program/failure.h>
#include <hpvi/program/interruption.h>
#include <hpvi/program/run.h>
#include <hpvi/program/swept_run.h>

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <sstream>

namespace hpvi
{
namespace
{
/** What a warning is about, up to its reasons and remedies: the run's own summary.json has all of it. */
std::string in_short(const std::string &warning)
{
  return warning.substr(0, std::min(warning.find(": "), warning.find("; ")));
}

/** The columns behind the name. */
std::string columns(const std::string &status, const std::string &energy,
                    const std::string &unknowns, const std::string &seconds)
{
  std::ostringstream text;
  text << "  " << std::left << std::setw(11) << status << std::right << std::setw(14) << energy
       << std::setw(11) << unknowns << std::setw(10) << seconds;
  return text.str();
}

std::string padded(const std::string &name, const std::size_t width)
{
  return name + std::string(width - std::min(width, name.size()), ' ');
}
} // namespace

int interrupting_signal()
{
  try
  {
    stop_if_interrupted();
  }
  catch (const Interruption &interruption)
  {
    return interruption.signal;
  }
  return 0;
}

template <int dim>
SweptRun SweptRun::solved(const Scene<dim> &scene, const std::string &directory)
{
  const auto start = std::chrono::steady_clock::now();
  SweptRun run;
  bool has_begun = false;
  RunListener<dim> listener;
  listener.on_stage = [](const Progress &) { stop_if_interrupted(); };
  listener.begun = [&](const Output<dim> &) { has_begun = true; };
  listener.finished = [&](const StepReport<dim> &step) { run.warnings = texts(step.warnings); };
  try
  {
    run_silently<dim>(scene, directory, listener);
    run.status = RunStatus::done;
  }
  catch (const Interruption &)
  {
    if (has_begun)
      run.status = RunStatus::interrupted;
  }
  catch (const std::exception &error)
  {
    run.status = dynamic_cast<const InputError *>(&error) ? RunStatus::refused : RunStatus::failed;
    run.message = failure_line(error);
    run.is_short_of_memory = is_out_of_memory(error);
  }
  forget_memory_claim();
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

std::string SweptRun::head(const std::size_t width)
{
  return padded("scene", width) + columns("status", "energy", "dofs_free", "seconds");
}

std::string SweptRun::line(const std::string &name, const std::size_t width,
                           const Record &last_row) const
{
  const std::optional<double> energy = number_of(last_row, "energy");
  const std::string unknowns = words_of(last_row, "dofs_free");
  std::ostringstream time;
  time << std::fixed << std::setprecision(2) << seconds;
  std::string result = padded(name, width) + columns(text(status), energy ? text(*energy, 8) : "-",
                                                     unknowns.empty() ? "-" : unknowns,
                                                     was_done ? "before" : time.str());
  if (was_postponed)
    result += "  alone, for beside others it was short of memory";
  if (!message.empty())
    result += "  " + message;
  for (const std::string &warning : warnings)
    result += (&warning == &warnings.front() ? "  warning: " : "; ") + in_short(warning);
  return result;
}

template SweptRun SweptRun::solved(const Scene<2> &, const std::string &);
template SweptRun SweptRun::solved(const Scene<3> &, const std::string &);
} // namespace hpvi
