// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/primal/cell_numbers.h>

#include <deal.II/base/mpi.h>

namespace hpvi
{
using namespace dealii;

std::vector<std::vector<double>> join_cells(const CellNumbers &own, const unsigned int n_cells,
                                            MPI_Comm communicator)
{
  std::vector<std::vector<double>> result(n_cells);
  for (const CellNumbers &part : Utilities::MPI::all_gather(communicator, own))
    for (const auto &[cell, numbers] : part)
      result[cell] = numbers;
  return result;
}
} // namespace hpvi
