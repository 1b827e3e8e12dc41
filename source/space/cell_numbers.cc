// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/processes.h>
#include <hpvi/space/cell_numbers.h>

#include <deal.II/base/mpi.h>

#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Of all processes in turn. Utilities::MPI::all_gather() would compress them, which takes longer than all else. */
std::vector<double> gather(const std::vector<double> &own, MPI_Comm communicator)
{
  const unsigned int n = hpvi::n_processes(communicator);
  if (n == 1)
    return own;
  std::vector<int> counts(n), first(n);
  const int count = own.size();
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
  std::partial_sum(counts.begin(), counts.end() - 1, first.begin() + 1);
  std::vector<double> all(first.back() + counts.back());
  MPI_Allgatherv(own.data(), count, MPI_DOUBLE, all.data(), counts.data(), first.data(), MPI_DOUBLE,
                 communicator);
  return all;
}
} // namespace

std::vector<std::vector<double>> join_cells(const CellNumbers &own, const unsigned int n_cells,
                                            MPI_Comm communicator)
{
  std::vector<double> records; // the cell, how many numbers it has, and these
  for (const auto &[cell, numbers] : own)
  {
    records.push_back(static_cast<double>(cell));
    records.push_back(static_cast<double>(numbers.size()));
    records.insert(records.end(), numbers.begin(), numbers.end());
  }
  const std::vector<double> all = gather(records, communicator);
  std::vector<std::vector<double>> result(n_cells);
  for (auto record = all.begin(); record != all.end();)
  {
    const auto numbers = record + 2, end = numbers + static_cast<std::ptrdiff_t>(record[1]);
    result[static_cast<std::size_t>(record[0])].assign(numbers, end);
    record = end;
  }
  return result;
}
} // namespace hpvi
