// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_linear_solver_h
#define hpvi_linear_solver_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>
#include <hpvi/solver/quadratic_program.h>
#include <hpvi/solver/symmetric_matrix.h>

#include <memory>
#include <vector>

namespace hpvi
{
/**
 * Reduction of `A u + B' lambda = f` to the multiplier: `S = B A^-1 B'`, `d = B A^-1 f` (5.6),
 * (5.7). The sparse Cholesky factorisation `A = L L'` takes the contact unknowns c last; then its
 * trailing block L_cc is dense and `S = Y'Y` with `Y = L_cc^-1 B_c'`, so S costs one triangular
 * solve with a small dense matrix and no sparse solve at all. This is the one place that chooses
 * ordering and solver: CHOLMOD (doi:10.1145/1391989.1391995), supernodal, ordered by constrained
 * AMD; tests/benchmark/solvers.cc measures MUMPS beside it.
 */
class SchurComplement
{
public:
  /**
   * Factor @p A. @p contact (ascending) are the unknowns that belong to the columns of @p B.
   * Throws NumericalFailure if A is not positive definite.
   */
  SchurComplement(const SymmetricMatrix &A, const dealii::Vector<double> &f,
                  const std::vector<unsigned int> &contact, const dealii::FullMatrix<double> &B);
  ~SchurComplement();

  const dealii::LAPACKFullMatrix<double> &S() const; ///< n_multipliers x n_multipliers
  const dealii::Vector<double> &d() const;           ///< n_multipliers

  /** `x = A^-1 (f - B' lambda)`. */
  dealii::Vector<double> displacement(const dealii::Vector<double> &lambda) const;

  /** `A^-1 f` for another right-hand side. */
  dealii::Vector<double> solve(const dealii::Vector<double> &f) const;

  std::size_t factor_entries() const; ///< entries stored for L

private:
  struct Factor;
  std::unique_ptr<Factor> factor;
  dealii::LAPACKFullMatrix<double> Y; ///< L_cc^-1 B_c'
  dealii::LAPACKFullMatrix<double> schur_matrix;
  dealii::Vector<double> reduced_load;
};
} // namespace hpvi

#endif
