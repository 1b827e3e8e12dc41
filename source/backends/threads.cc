// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/backends/backend.h>
#include <hpvi/backends/threads.h>
#include <hpvi/base/cores.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/processes.h>

namespace hpvi
{
template <int dim>
unsigned int n_threads(const Scene<dim> &scene, const unsigned int n_processes)
{
  if (takes_primal_path(scene, n_processes) || mapping_is_limited())
    return 1;
  return scene.solver.threads > 0 ? scene.solver.threads : n_usable_cores();
}

template <int dim>
Team team_of(const Scene<dim> &scene, MPI_Comm communicator)
{
  return Team(n_threads(scene, n_processes(communicator)));
}

template Team team_of(const Scene<2> &, MPI_Comm);
template Team team_of(const Scene<3> &, MPI_Comm);
template unsigned int n_threads(const Scene<2> &, unsigned int);
template unsigned int n_threads(const Scene<3> &, unsigned int);
} // namespace hpvi
