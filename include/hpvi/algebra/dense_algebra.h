// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_dense_algebra_h
#define hpvi_dense_algebra_h

#include <deal.II/base/types.h>
#include <deal.II/lac/lapack_support.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace hpvi
{
/** (a, b), a sum whose bits do not depend on the number of threads, unlike deal.II's product. */
double dot(const dealii::Vector<double> &a, const dealii::Vector<double> &b);

/** Entry by entry, likewise. */
double sum(const std::vector<double> &values);

/** A part of a dense matrix of doubles, stored by columns. */
struct DensePart
{
  const double *entries;
  unsigned int stride; ///< from column to column
};

/** `C := alpha op(A) op(B) + beta C`, C rows x columns; op transposes where its letter is 'T'. */
void multiply(char op_A, char op_B, unsigned int rows, unsigned int columns, unsigned int inner,
              double alpha, DensePart A, DensePart B, double beta, double *C, unsigned int stride);

/** Throws NumericalFailure, that round-off spoils @p what of cells, unless their matrix is positive definite. */
void require_regular(bool is_positive_definite, const char *what);

/**
 * Cholesky with pivots of a positive semidefinite matrix (n x n, both triangles given): rows and
 * columns order[0], order[1], ... until the next pivot is below tolerance times the first.
 */
struct PivotedCholesky
{
  PivotedCholesky() = default;
  PivotedCholesky(unsigned int n, const std::vector<double> &A, double tolerance);

  /** One of the solutions of `A x = b`, for b in the range of A. */
  std::vector<double> solve(const std::vector<double> &b) const;

  std::vector<unsigned int> order; ///< as long as the rank
  std::vector<double> L;           ///< rank x rank
  unsigned int n = 0;
};

/** `x` solves `A x = b`: a dense LU factor, its matrix by columns. */
class LuFactor
{
public:
  LuFactor(std::vector<double> matrix, unsigned int n);

  bool is_singular() const; ///< to round-off; also where an entry is no number

  void solve(std::vector<double> &x) const; ///< x := A^-1 x

private:
  std::vector<double> factor;
  std::vector<dealii::types::blas_int> pivots;
  dealii::types::blas_int n;
  double reciprocal_condition = 0;
};
} // namespace hpvi

#endif
