// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/multigrid/coarse_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/mpi.templates.h>

#include <algorithm>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
using Entries = std::map<std::pair<unsigned int, unsigned int>, double>; ///< by column and row

/** Of the cells of this process. */
Entries own_entries(const MomentSpace<3> &space)
{
  const BoxStiffness<3> stiffness(space);
  Entries result;
  std::vector<types::global_dof_index> dofs(space.tables.fe.dofs_per_cell);
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      cell->get_dof_indices(dofs);
      const FullMatrix<double> &K = stiffness(cell, space.moment_components(cell));
      for (unsigned int i = 0; i < dofs.size(); ++i)
        for (unsigned int j = 0; j < dofs.size(); ++j)
          if (dofs[i] == dofs[j] ||
              (dofs[i] < dofs[j] && K(i, j) != 0 && !space.constraints.is_constrained(dofs[i]) &&
               !space.constraints.is_constrained(dofs[j])))
            result[{dofs[j], dofs[i]}] += space.constraints.is_constrained(dofs[i]) ? 1. : K(i, j);
    }
  // A disc couples its directions even where A does not.
  for (const auto &moment : space.contact)
  {
    const auto a = space.owned.nth_index_in_set(moment.unknowns[0]),
               b = space.owned.nth_index_in_set(moment.unknowns[1]);
    result[{std::max(a, b), std::min(a, b)}] += 0;
  }
  return result;
}
} // namespace

// The coarsest mesh has no hanging nodes: what is constrained is prescribed.
CoarseSolver::CoarseSolver(const MultigridLevel<float> &level) : level(level)
{
  Entries all;
  std::vector<std::pair<std::pair<unsigned int, unsigned int>, double>> mine;
  for (const auto &entry : own_entries(level.space))
    mine.push_back(entry);
  for (const auto &part : Utilities::MPI::all_gather(level.space.communicator(), mine))
    for (const auto &[place, value] : part)
      all[place] += value;
  A.resize(all.size());
  std::size_t n = 0;
  for (const auto &[place, value] : all)
  {
    for (; A.n() < place.first; A.column_start.push_back(n))
      ;
    A.row[n] = place.second;
    A.value[n++] = value;
  }
  A.column_start.push_back(n);
}

std::size_t CoarseSolver::entry(const unsigned int row, const unsigned int column) const
{
  const auto begin = A.row.begin() + A.column_start[column],
             end = A.row.begin() + A.column_start[column + 1];
  return std::lower_bound(begin, end, static_cast<int>(row)) - A.row.begin();
}

void CoarseSolver::factor()
{
  const MomentSpace<3> &space = level.space;
  std::vector<unsigned int> held;
  std::vector<std::pair<std::pair<unsigned int, unsigned int>, double>> added;
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
            added.push_back({{unknown(t), unknown(s)}, level.states[k].stiffness[s][t]});
    }
  SymmetricMatrix linearised = A;
  for (const auto &part : Utilities::MPI::all_gather(space.communicator(), added))
    for (const auto &[place, value] : part)
      linearised.value[entry(place.first, place.second)] += value;
  std::vector<bool> is_held(A.n(), false);
  for (const auto &part : Utilities::MPI::all_gather(space.communicator(), held))
    for (const unsigned int i : part)
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
