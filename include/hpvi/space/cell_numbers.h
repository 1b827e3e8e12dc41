// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cell_numbers_h
#define hpvi_cell_numbers_h

#include <deal.II/base/types.h>

#include <mpi.h>

#include <utility>
#include <vector>

namespace hpvi
{
/** Numbers of cells of this process, by cell_ranks(). */
using CellNumbers = std::vector<std::pair<dealii::types::global_cell_index, std::vector<double>>>;

/** Those of all @p n_cells cells of all processes. Collective. */
std::vector<std::vector<double>> join_cells(const CellNumbers &own, unsigned int n_cells,
                                            MPI_Comm communicator);
} // namespace hpvi

#endif
