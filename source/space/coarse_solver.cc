// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/gathered.h>
#include <hpvi/space/cell_basis.h>
#include <hpvi/space/coarse_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>

#include <algorithm>
#include <tuple>

namespace hpvi
{
using namespace dealii;

namespace
{
struct Entry
{
  unsigned int column, row;
  double value;
};

bool is_before(const Entry &one, const Entry &other)
{
  return std::tie(one.column, one.row) < std::tie(other.column, other.row);
}

/** Of the upper triangle, from the cells of this process. */
std::vector<Entry> own_entries(const PrimalSpace<3> &space)
{
  DynamicSparsityPattern dynamic(space.dof_handler.n_dofs());
  DoFTools::make_sparsity_pattern(space.dof_handler, dynamic, space.constraints, false);
  std::vector<CellBasis> with_opposite; // cell by cell
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && has_opposite(space, cell))
    {
      with_opposite.push_back(cell_basis(space, cell));
      for (const auto row : with_opposite.back().unknowns)
        for (const auto column : with_opposite.back().unknowns)
          dynamic.add(row, column);
    }
  auto next = with_opposite.begin();
  SparsityPattern pattern;
  pattern.copy_from(dynamic);
  SparseMatrix<double> matrix(pattern);
  const BoxStiffness<3> stiffness(space);
  std::vector<types::global_dof_index> dofs;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && has_opposite(space, cell))
    {
      const FullMatrix<double> &K = stiffness.nodal(cell);
      matrix.add(next->unknowns, next->transformed(K));
      space.tables.take_dofs(cell, dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (space.constraints.is_constrained(dofs[i]))
          matrix.add(dofs[i], dofs[i], K(i, i));
      ++next;
    }
    else if (cell->is_locally_owned())
    {
      space.tables.take_dofs(cell, dofs);
      space.constraints.distribute_local_to_global(stiffness(cell), dofs, matrix);
    }
  std::vector<Entry> result;
  for (const auto &entry : matrix) // those of cells of other processes are not there
    if (entry.row() <= entry.column())
      result.push_back({static_cast<unsigned int>(entry.column()),
                        static_cast<unsigned int>(entry.row()), entry.value()});
  return result;
}
} // namespace

// The coarsest mesh has no hanging nodes: what is constrained is prescribed. All entries of a cell are kept, zeros too: a
// disc couples its directions even where A does not.
CoarseSolver::CoarseSolver(const MultigridLevel<float> &level) : level(level)
{
  std::vector<Entry> all = gathered(own_entries(level.space), level.space.communicator());
  std::sort(all.begin(), all.end(), is_before);
  A.reserve(all.size());
  for (std::size_t e = 0; e < all.size(); ++e)
  {
    if (e > 0 && !is_before(all[e - 1], all[e]))
    {
      A.value.back() += all[e].value;
      continue;
    }
    while (A.n() < all[e].column)
      A.column_start.push_back(A.row.size());
    A.row.push_back(all[e].row);
    A.value.push_back(all[e].value);
  }
  A.column_start.push_back(A.row.size());
}

std::size_t CoarseSolver::entry(const unsigned int row, const unsigned int column) const
{
  const auto begin = A.row.begin() + A.column_start[column],
             end = A.row.begin() + A.column_start[column + 1];
  return std::lower_bound(begin, end, static_cast<int>(row)) - A.row.begin();
}

void CoarseSolver::factor()
{
  const PrimalSpace<3> &space = level.space;
  std::vector<unsigned int> held;
  std::vector<Entry> added;
  for (unsigned int k = 0; k < level.states.size(); ++k)
    for (unsigned int s = 0; s < space.contact[k].n_unknowns(); ++s)
    {
      const auto unknown = [&](const unsigned int t)
      { return space.owned.nth_index_in_set(space.contact[k].unknowns[t]); };
      if (level.states[k].is_held)
        held.push_back(unknown(s));
      else
        for (unsigned int t = 0; t < space.contact[k].n_unknowns(); ++t)
          if (unknown(t) <= unknown(s))
            added.push_back({unknown(s), unknown(t), level.states[k].stiffness[s][t]});
    }
  SymmetricMatrix linearised = A;
  for (const Entry &one : gathered(added, space.communicator()))
    linearised.value[entry(one.row, one.column)] += one.value;
  std::vector<bool> is_held(A.n(), false);
  for (const unsigned int i : gathered(held, space.communicator()))
    is_held[i] = true;
  for (unsigned int column = 0; column < A.n(); ++column)
    for (int e = A.column_start[column]; e < A.column_start[column + 1]; ++e)
      if (is_held[column] || is_held[A.row[e]])
        linearised.value[e] = A.row[e] == static_cast<int>(column) ? 1. : 0.;
  if (solver)
    solver->factor_again(linearised);
  else
    solver = std::make_unique<LinearSolver>(linearised, std::vector<unsigned int>());
}

void CoarseSolver::solve(Vector &x, const Vector &b) const
{
  const IndexSet &owned = level.space.owned;
  std::vector<double> right(A.n(), 0.);
  for (unsigned int i = 0; i < owned.n_elements(); ++i)
    right[owned.nth_index_in_set(i)] = b.local_element(i);
  Utilities::MPI::sum(right, level.space.communicator(), right);
  const dealii::Vector<double> solution =
      solver->solve(dealii::Vector<double>(right.begin(), right.end()));
  for (unsigned int i = 0; i < owned.n_elements(); ++i)
    x.local_element(i) = solution[owned.nth_index_in_set(i)];
  level.mask(x);
}
} // namespace hpvi
