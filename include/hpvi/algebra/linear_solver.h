// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_linear_solver_h
#define hpvi_linear_solver_h

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>
#include <hpvi/algebra/elimination_hints.h>
#include <hpvi/algebra/symmetric_matrix.h>

#include <memory>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * `stiffness P P'`, added to a singular matrix A, one for each of its null vectors R so that `P'R` is
 * regular. It carries no force where `R'f = 0`: then A^-1 is a generalised inverse of the matrix without
 * it.
 */
struct Stabilisation
{
  std::vector<std::pair<unsigned int, double>> P; ///< entries that are not zero, ascending
  double stiffness = 0;
};

/**
 * The sparse Cholesky factorisation `A = L L'`, which takes some unknowns last: the kept ones, those
 * of the contact. The trailing block C of L is then dense and holds the Schur complement on them,
 * `A_kk - A_ki A_ii^-1 A_ik = C C'`. This is the one place that chooses the solver: supernodes of CHOLMOD
 * (doi:10.1145/1391989.1391995) in the order of Elimination, with numbers of factor_supernodes(); tests/benchmark/solvers.cc measures MUMPS
 * beside it.
 */
class LinearSolver
{
public:
  /**
   * Factor @p A. @p more_bytes are those that the caller will want beside L; @p hints are known of A without a look at it.
   * Throws NumericalFailure if A is not positive definite or memory does not suffice.
   */
  LinearSolver(const SymmetricMatrix &A, const std::vector<unsigned int> &interface,
               double more_bytes = 0., const std::vector<Stabilisation> &stabilisation = {},
               const EliminationHints &hints = {});
  LinearSolver(LinearSolver &&);
  ~LinearSolver();

  /** Factor another matrix with entries in the same places, in the same order and memory. Throws NumericalFailure. */
  void factor_again(const SymmetricMatrix &A, const std::vector<Stabilisation> &stabilisation = {});

  /** `A^-1 f` */
  dealii::Vector<double> solve(const dealii::Vector<double> &f) const;

  /** `y = L^-1 f`, in the order of elimination: interface dofs last. */
  dealii::Vector<double> forward(const dealii::Vector<double> &f) const;

  /** `L^-T y`: what is left of solve() after forward(). */
  dealii::Vector<double> backward(const dealii::Vector<double> &y) const;

  const dealii::LAPACKFullMatrix<double> &kept_factor() const; ///< C, lower triangular

  /** The place in interface of each row of C. */
  const std::vector<unsigned int> &interface_order() const;

private:
  struct Factor;
  std::unique_ptr<Factor> factor;
};
} // namespace hpvi

#endif
