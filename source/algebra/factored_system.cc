// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/factored_system.h>

#include <algorithm>
#include <utility>

namespace hpvi
{
using namespace dealii;

FactoredSystem::FactoredSystem(LinearSolver factored, const Vector<double> &f,
                               const ConditionRows &rows)
    : solver(std::move(factored)), reduction(solver, f, rows)
{
}

void FactoredSystem::remember(const SymmetricMatrix &A,
                              const std::vector<Stabilisation> &stabilisation,
                              const ConditionRows &rows)
{
  known_A = A;
  known_stabilisation = stabilisation;
  known_rows = rows;
}

bool FactoredSystem::is_of(const SymmetricMatrix &A,
                           const std::vector<Stabilisation> &stabilisation,
                           const ConditionRows &rows) const
{
  const auto same = [](const Stabilisation &a, const Stabilisation &b)
  { return a.P == b.P && a.stiffness == b.stiffness; };
  return known_A.column_start == A.column_start && known_A.row == A.row &&
         known_A.value == A.value && known_rows.kept == rows.kept && known_rows.B == rows.B &&
         std::equal(known_stabilisation.begin(), known_stabilisation.end(), stabilisation.begin(),
                    stabilisation.end(), same);
}
} // namespace hpvi
