// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_threads_h
#define hpvi_threads_h

#include <hpvi/base/thread_pool.h>
#include <hpvi/scene/scene.h>

#include <mpi.h>

namespace hpvi
{
/**
 * On how many threads a step of @p scene is computed on one of @p n_processes: those of SolverSettings::threads, or of all cores that the
 * process may use and OMP_NUM_THREADS leaves it; one on the primal path, which has its processes, and where the memory that may be mapped is limited, for each takes 0.1 GB.
 */
template <int dim>
unsigned int n_threads(const Scene<dim> &scene, unsigned int n_processes);

/** As many, for the calling one. */
template <int dim>
ThreadPool thread_pool_of(const Scene<dim> &scene, MPI_Comm communicator);
} // namespace hpvi

#endif
