// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_processes_h
#define hpvi_processes_h

#include <deal.II/lac/la_parallel_vector.h>

#include <mpi.h>

#include <functional>

namespace hpvi
{
/** A vector whose entries are spread over the processes. */
using DistributedVector = dealii::LinearAlgebra::distributed::Vector<double>;

/**
 * Does @p work, which must not communicate, on every process. Where it throws on any of them all
 * throw what the first one had to say: InputError, NumericalFailure or std::runtime_error with one
 * line. So none waits for another that has given up.
 */
void collectively(MPI_Comm communicator, const std::function<void()> &work);

/** Of those of @p communicator; 1 in a program that has not started MPI. */
unsigned int n_processes(MPI_Comm communicator);

unsigned int rank_of(MPI_Comm communicator); ///< likewise 0

/** The sum over all processes of what @p work, done collectively(), returns on each. */
double sum_collectively(MPI_Comm communicator, const std::function<double()> &work);
} // namespace hpvi

#endif
