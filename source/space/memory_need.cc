// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/memory.h>
#include <hpvi/base/processes.h>
#include <hpvi/space/memory_need.h>
#include <hpvi/space/moment_matrix.h>

#include <deal.II/base/mpi.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * Of a process: matrix, its pattern, the levels of algebraic multigrid; or without a matrix vectors, unknowns and constraints of
 * all levels. Measured to a quarter, without a matrix to a tenth.
 */
template <int dim>
double expected_bytes(const MomentSpace<dim> &space)
{
  if (linear_method(space) == LinearMethod::multigrid)
    return 520. * space.owned.n_elements();
  const double n_cells = space.dof_handler.get_triangulation().n_global_active_cells() *
                         (double(space.owned.n_elements()) / space.dof_handler.n_dofs()),
               n = space.tables.fe.dofs_per_cell;
  return 19 * n_cells * n * n;
}

template <int dim>
std::string matrix_name(const MomentSpace<dim> &space)
{
  return (linear_method(space) == LinearMethod::multigrid ? "the levels of multigrid for "
                                                          : "the matrix and its multigrid for ") +
         std::to_string(space.dof_handler.n_dofs()) + " unknowns";
}
} // namespace

template <int dim>
std::string memory_note(const MomentSpace<dim> &space)
{
  const double bytes = Utilities::MPI::sum(expected_bytes(space), space.communicator());
  if (bytes < 1e9)
    return {};
  return matrix_name(space) + " take " + bytes_text(bytes) +
         " of memory; Adaptivity/Maximum unknowns ends a run before";
}

template <int dim>
void require_room(const MomentSpace<dim> &space)
{
  MPI_Comm machine;
  MPI_Comm_split_type(space.communicator(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const double bytes = Utilities::MPI::sum(expected_bytes(space), machine);
  MPI_Comm_free(&machine);
  together(space.communicator(), [&]() { require_memory(bytes, matrix_name(space)); });
}

template std::string memory_note(const MomentSpace<2> &);
template std::string memory_note(const MomentSpace<3> &);
template void require_room(const MomentSpace<2> &);
template void require_room(const MomentSpace<3> &);
} // namespace hpvi
