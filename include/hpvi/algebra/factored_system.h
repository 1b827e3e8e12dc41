// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_factored_system_h
#define hpvi_factored_system_h

#include <hpvi/algebra/schur_complement.h>

#include <memory>

namespace hpvi
{
/**
 * A factored and reduced to the contact, for one right-hand side after the other. Load steps on one mesh
 * have the same A, B and S as long as the same unknowns are prescribed and the same edges have friction:
 * the factorisation is most of their time.
 */
class FactoredSystem
{
public:
  /** @p solver holds the factor of A, @p f and @p rows are as in SchurComplement. */
  FactoredSystem(LinearSolver solver, const dealii::Vector<double> &f, const ConditionRows &rows);

  FactoredSystem(const FactoredSystem &) = delete; // members refer to one another

  LinearSolver solver;
  SchurComplement reduction;

  /** What has been factored, for is_of(). */
  void remember(const SymmetricMatrix &A, const std::vector<Stabilisation> &stabilisation,
                const ConditionRows &rows);

  /** Is this to the last bit what is remembered? */
  bool is_of(const SymmetricMatrix &A, const std::vector<Stabilisation> &stabilisation,
             const ConditionRows &rows) const;

private:
  SymmetricMatrix known_A; ///< without unknowns: nothing is remembered
  std::vector<Stabilisation> known_stabilisation;
  ConditionRows known_rows;
};
} // namespace hpvi

#endif
