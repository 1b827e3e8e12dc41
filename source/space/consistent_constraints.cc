// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/consistent_constraints.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
using Index = types::global_dof_index;
using Entries = std::vector<std::pair<Index, double>>;
using Line = std::pair<Index, std::pair<double, Entries>>; ///< unknown, inhomogeneity, the others

/** Those of @p unknowns, which belong to other processes, that are constrained. */
std::vector<Line> ask(const AffineConstraints<double> &constraints, const IndexSet &owned,
                      const IndexSet &unknowns, MPI_Comm communicator)
{
  const std::vector<unsigned int> owners =
      Utilities::MPI::compute_index_owner(owned, unknowns, communicator);
  std::map<unsigned int, std::vector<Index>> questions;
  auto owner = owners.begin();
  for (const Index i : unknowns)
    questions[*owner++].push_back(i);
  std::map<unsigned int, std::vector<Line>> answers;
  for (const auto &[process, indices] : Utilities::MPI::some_to_some(communicator, questions))
    for (const Index i : indices)
      if (constraints.is_constrained(i))
        answers[process].push_back(
            {i, {constraints.get_inhomogeneity(i), *constraints.get_constraint_entries(i)}});
  std::vector<Line> result;
  for (const auto &[process, lines] : Utilities::MPI::some_to_some(communicator, answers))
    result.insert(result.end(), lines.begin(), lines.end());
  return result;
}

/** The unknowns that the constraints on @p lines name, without @p known ones. */
IndexSet named(const std::vector<Line> &lines, const IndexSet &known)
{
  std::vector<Index> columns;
  for (const Line &line : lines)
    for (const auto &entry : line.second.second)
      if (!known.is_element(entry.first))
        columns.push_back(entry.first);
  std::sort(columns.begin(), columns.end());
  IndexSet result(known.size());
  result.add_indices(columns.begin(), std::unique(columns.begin(), columns.end()));
  result.compress();
  return result;
}
} // namespace

void make_consistent(AffineConstraints<double> &constraints, const IndexSet &owned,
                     const IndexSet &relevant, MPI_Comm communicator)
{
  std::vector<Line> lines;
  for (const auto &line : constraints.get_lines())
    if (owned.is_element(line.index))
      lines.push_back({line.index, {line.inhomogeneity, line.entries}});
  IndexSet known = owned, wanted = named(lines, owned);
  wanted.add_indices(relevant);
  wanted.subtract_set(owned);
  while (Utilities::MPI::max(wanted.n_elements(), communicator) > 0)
  {
    const std::vector<Line> answers = ask(constraints, owned, wanted, communicator);
    known.add_indices(wanted);
    wanted = named(answers, known);
    lines.insert(lines.end(), answers.begin(), answers.end());
  }
  constraints.reinit(known);
  for (const Line &line : lines)
  {
    constraints.add_line(line.first);
    constraints.set_inhomogeneity(line.first, line.second.first);
    constraints.add_entries(line.first, line.second.second);
  }
  constraints.close();
}
} // namespace hpvi
