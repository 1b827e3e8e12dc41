// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_primal_run_h
#define hpvi_primal_run_h

#include <hpvi/scene/scene.h>

#include <functional>
#include <string>

namespace hpvi
{
/** Does the environment say that mpirun has started several processes? A program started by one of them inherits it. */
bool may_have_company();

/** How many processes share the work, as MPI knows it; 1 where it has not been started. */
unsigned int n_started_processes();

/** Is this the one of them that speaks for all? */
bool is_first_process();

/** Does @p work together() with the other processes, where there are any: what one cannot read fails on all. */
void agree(const std::function<void()> &work);

/**
 * Does @p scene take the primal path: in space, on several processes, because it says so, or because its first mesh has
 * so many multipliers that their dense algebra would take longer? Throws InputError
 * where it asks for the reduced path on several processes.
 */
template <int dim>
bool takes_primal_path(const Scene<dim> &scene);

/** Solve @p scene by the primal path on all processes, print its rows and leave its files in @p directory. */
template <int dim>
void run_primal(const Scene<dim> &scene, const std::string &directory);
} // namespace hpvi

#endif
