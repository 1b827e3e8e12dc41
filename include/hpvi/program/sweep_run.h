// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_sweep_run_h
#define hpvi_sweep_run_h

#include <hpvi/program/command_line.h>

#include <functional>

namespace hpvi
{
/**
 * `hpvi --sweep`: all scenes are read and checked, then solved, each as run() would alone, on as many threads as there are
 * cores. Those of the primal path, whose libraries know of one thread alone, come one after the other behind them; what
 * @p start_mpi does comes before these. A scene that finds too little memory beside others is solved again when they are
 * over. Prints a line for each, and keeps `sweep.csv`. Throws InputError before anything is solved or where the data of
 * some could not be used, NumericalFailure where some were not solved, Interruption.
 */
template <int dim>
void sweep(const CommandLine &command_line, const std::function<void()> &start_mpi);
} // namespace hpvi

#endif
