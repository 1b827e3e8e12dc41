// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_iterative_refinement_h
#define hpvi_iterative_refinement_h

#include <hpvi/plane/reduced_problem.h>

#include <algorithm>

namespace hpvi
{
/** How exactly `A u + B' z = f` is solved. */
struct AlgebraicError
{
  /**
   * |u - u_N|_a / |u_N|_a as far as the factorisation A = LL' can tell: `(r' A^-1 r)^{1/2}` with the
   * residual r. Zero where the work of r on u_N, which costs no solve, shows that it is below 1e-5.
   */
  double relative = 0;
  double multiplier = 0;        ///< the last change of z_N that corrections asked for
  unsigned int corrections = 0; ///< steps of conjugate gradients taken, of all passes
  double energy_product = 0;    ///< a(u_N,u_N), from strains

  double total() const
  {
    return std::max(relative, multiplier);
  }

  /** Beyond this the digits that a table shows are in doubt: a warning. */
  static constexpr double doubtful = 1e-6;
  /** Beyond this it is no result. */
  static constexpr double useless = 1e-2;
};

/**
 * Corrects what round-off did to the displacement. The error of a direct solve is round-off times
 * the condition number: of slender bodies it reaches the size of the solution. The residual
 * `r = f - B' z - A u` is formed from strains (see InternalForces) and its work on u compared
 * with a(u,u). Where they contradict each other, conjugate gradients preconditioned by the
 * factorisation bring u to the exact solution of the discrete problem; they need a few steps, since the
 * factorisation is wrong in a few directions only.
 */
template <int dim>
class IterativeRefinement
{
public:
  /** All must outlive this object. */
  IterativeRefinement(const Discretisation<dim> &discretisation,
                      const CondensedElements<dim> &elements, const LinearSolver &solver,
                      const SchurComplement &schur_complement);

  /** The displacement as the factorisation has it, and likewise the multiplier. Throws what solve() throws. */
  dealii::Vector<double> uncorrected(ReducedSolution &reduced) const;

  /**
   * The displacement, and the multiplier in @p reduced, which comes with the starting value. Where
   * the displacement has to be corrected, S and d carry the same round-off: the multiplier is then
   * found again from what the corrected displacement does at the contact boundary, until it stays
   * where it is. @p is_suspect: correct whatever the work of the residual says. Throws what solve_reduced_problem throws.
   */
  dealii::Vector<double> solve(ReducedSolution &reduced, AlgebraicError &error,
                               bool is_suspect = false) const;

  /**
   * Improve @p u, the solution for the multiplier @p z, and say how exact it is now. @p is_suspect: as above.
   */
  AlgebraicError improve(const dealii::Vector<double> &z, dealii::Vector<double> &u,
                         bool is_suspect = false) const;

private:
  dealii::Vector<double> displacement_between(const ReducedSolution &from,
                                              const ReducedSolution &to) const;
  dealii::Vector<double> residual(const dealii::Vector<double> &z, const dealii::Vector<double> &u,
                                  double &energy_product) const;
  double round_off_energy(const dealii::Vector<double> &u) const;
  bool contradicts(const dealii::Vector<double> &residual, const dealii::Vector<double> &u,
                   double energy_product) const;

  const Discretisation<dim> &discretisation;
  const CondensedElements<dim> &elements;
  const LinearSolver &solver;
  const SchurComplement &schur_complement;
};
} // namespace hpvi

#endif
