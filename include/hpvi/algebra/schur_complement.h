// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_schur_complement_h
#define hpvi_schur_complement_h

#include <hpvi/algebra/linear_solver.h>

namespace hpvi
{
/** Conditions on few unknowns x of a linear system: row i says something of `sum_k B_ik x_k + prescribed_i`. */
struct ConditionRows
{
  using Row = std::vector<std::pair<unsigned int, double>>;

  std::vector<unsigned int> interface; ///< the unknowns that occur, ascending: the columns of B
  std::vector<Row> B;                  ///< place in interface and weight
  dealii::Vector<double> prescribed;   ///< what does not depend on x

  unsigned int n_rows() const
  {
    return B.size();
  }
};

/**
 * Reduction of `A x + B' z = f` to z: `S = B A^-1 B'`, `d = B A^-1 f + prescribed` (5.6), (5.7). With
 * C, the factor of the unknowns that B touches, `S = Y'Y`, `Y = C^-1 B'`: a triangular solve with a
 * small dense matrix and no sparse solve at all. Where B is the diagonal matrix W of moments,
 * `S = W S_p^-1 W` with the primal Schur complement `S_p = C C'` on them.
 */
class SchurComplement
{
public:
  /** @p solver, of A with the interface dofs of @p rows, must outlive this object. */
  SchurComplement(const LinearSolver &solver, const dealii::Vector<double> &f,
                  const ConditionRows &rows);

  /** The same A and B with another f and another prescribed part. */
  void set_load(const dealii::Vector<double> &f, const dealii::Vector<double> &prescribed);

  const dealii::LAPACKFullMatrix<double> &S() const; ///< n_rows x n_rows
  const dealii::Vector<double> &d() const;           ///< n_rows

  /** `x = A^-1 (f - B' z)` */
  dealii::Vector<double> displacement(const dealii::Vector<double> &z) const;

  /** `-A^-1 B' z`, what @p z adds to it */
  dealii::Vector<double> response(const dealii::Vector<double> &z) const;

private:
  dealii::Vector<double> backward(dealii::Vector<double> right_hand_side,
                                  const dealii::Vector<double> &z) const;

  const LinearSolver &solver;
  dealii::Vector<double> y;           ///< L^-1 f
  dealii::LAPACKFullMatrix<double> Y; ///< C^-1 B'
  dealii::LAPACKFullMatrix<double> schur_matrix;
  dealii::Vector<double> reduced_load;
};
} // namespace hpvi

#endif
