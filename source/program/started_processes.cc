// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/processes.h>
#include <hpvi/program/started_processes.h>

#include <deal.II/base/mpi.h>

#include <cstdlib>

namespace hpvi
{
using namespace dealii;

bool may_have_company()
{
  for (const char *const variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) // Open MPI, MPICH
    if (const char *const value = std::getenv(variable))
      return std::atoi(value) > 1;
  return false;
}

unsigned int n_started_processes()
{
  return hpvi::n_processes(MPI_COMM_WORLD);
}

bool is_first_process()
{
  return rank_of(MPI_COMM_WORLD) == 0;
}

void in_all_processes(const std::function<void()> &work)
{
  collectively(MPI_COMM_WORLD, work);
}
} // namespace hpvi
