// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/input_error.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/text.h>

#include <deal.II/base/mpi.h>

#include <new>
#include <string>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
enum class Outcome : unsigned int
{
  done,
  bad_input,
  bad_input_at_a_time, ///< InputError::names_time
  gave_up,
  other
};

std::pair<Outcome, std::string> outcome_of(const std::function<void()> &work)
{
  try
  {
    work();
    return {Outcome::done, ""};
  }
  catch (const InputError &error)
  {
    return {error.names_time ? Outcome::bad_input_at_a_time : Outcome::bad_input, error.what()};
  }
  catch (const NumericalFailure &error)
  {
    return {Outcome::gave_up, error.what()};
  }
  catch (const std::bad_alloc &)
  {
    return {Outcome::gave_up, "out of memory; lower Adaptivity/Maximum unknowns, take fewer "
                              "Geometry/Subdivisions or allow more memory"};
  }
  catch (const std::exception &error)
  {
    return {Outcome::other, one_line(error)};
  }
}
} // namespace

unsigned int n_processes(MPI_Comm communicator)
{
  return Utilities::MPI::job_supports_mpi() ? Utilities::MPI::n_mpi_processes(communicator) : 1;
}

unsigned int rank_of(MPI_Comm communicator)
{
  return Utilities::MPI::job_supports_mpi() ? Utilities::MPI::this_mpi_process(communicator) : 0;
}

void collectively(MPI_Comm communicator, const std::function<void()> &work)
{
  if (n_processes(communicator) == 1)
    return work();
  auto [outcome, message] = outcome_of(work);
  const unsigned int rank = rank_of(communicator), n = n_processes(communicator),
                     first = Utilities::MPI::min(outcome == Outcome::done ? n : rank, communicator);
  if (first == n)
    return;
  outcome = static_cast<Outcome>(
      Utilities::MPI::broadcast(communicator, static_cast<unsigned int>(outcome), first));
  message = Utilities::MPI::broadcast(communicator, message, first);
  if (outcome == Outcome::bad_input || outcome == Outcome::bad_input_at_a_time)
    throw InputError(message, outcome == Outcome::bad_input_at_a_time);
  if (outcome == Outcome::gave_up)
    throw NumericalFailure(message);
  throw std::runtime_error(message);
}

double sum_collectively(MPI_Comm communicator, const std::function<double()> &work)
{
  double sum = 0;
  collectively(communicator, [&]() { sum = work(); });
  return Utilities::MPI::sum(sum, communicator);
}
} // namespace hpvi
