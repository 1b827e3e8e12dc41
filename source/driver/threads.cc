// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/cores.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/processes.h>
#include <hpvi/driver/backend.h>
#include <hpvi/driver/threads.h>

#include <algorithm>
#include <cstdlib>

namespace hpvi
{
namespace
{
/** All cores, or as many as OMP_NUM_THREADS says, by which other programs go, too. */
unsigned int n_offered()
{
  const char *const value = std::getenv("OMP_NUM_THREADS");
  const unsigned long n = value ? std::strtoul(value, nullptr, 10) : 0;
  return n > 0 ? std::min<unsigned long>(n, n_usable_cores()) : n_usable_cores();
}
} // namespace

template <int dim>
unsigned int n_threads(const Scene<dim> &scene, const unsigned int n_processes)
{
  if (takes_primal_path(scene, n_processes) || mapping_is_limited())
    return 1;
  constexpr unsigned int most = 64; // dense algebra has no room for some hundred
  return std::min(most, scene.solver.threads > 0 ? scene.solver.threads : n_offered());
}

template <int dim>
ThreadPool thread_pool_of(const Scene<dim> &scene, MPI_Comm communicator)
{
  return ThreadPool(n_threads(scene, n_processes(communicator)));
}

template ThreadPool thread_pool_of(const Scene<2> &, MPI_Comm);
template ThreadPool thread_pool_of(const Scene<3> &, MPI_Comm);
template unsigned int n_threads(const Scene<2> &, unsigned int);
template unsigned int n_threads(const Scene<3> &, unsigned int);
} // namespace hpvi
