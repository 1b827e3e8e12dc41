// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_triangular_h
#define hpvi_triangular_h

#include <hpvi/algebra/dense_algebra.h>

#include <vector>

namespace hpvi
{
/** A := L with `A = L L'`, in the lower triangle; what stands above is lost. Is A positive definite? */
bool cholesky(unsigned int n, double *A, unsigned int stride);

/** The same for the first @p width columns of n rows alone, entry by entry; others stay as they are. */
bool factor_columns(unsigned int n, unsigned int width, double *A, unsigned int stride);

/** `B := op(L)^-1 B` with L lower triangular of size n, B n x columns. */
void solve_triangular(char op, unsigned int n, unsigned int columns, DensePart L, double *B,
                      unsigned int stride);

/** `x := A^-1 x` with L of A, n x n. */
void solve_by_cholesky(unsigned int n, const std::vector<double> &L, double *x);

/**
 * A symmetric matrix, then its factor L, in half the memory of a square: columns stand in panels of sixteen, each from the first
 * row of its panel on.
 */
class PackedTriangle
{
public:
  explicit PackedTriangle(unsigned int n = 0); ///< of zeros

  unsigned int size() const
  {
    return n;
  }

  /** Entry (i, j) at i, from j on; those between the diagonal and the panel's first row are of no account. */
  double *column(unsigned int j);
  const double *column(unsigned int j) const;

  /** Is the matrix positive definite? */
  bool factor();

  /** `B := op(L)^-1 B`, B n x columns; one column where op transposes. */
  void solve(char op, unsigned int columns, double *B, unsigned int stride) const;

private:
  std::size_t place(unsigned int j) const;

  unsigned int n;
  std::vector<double> entries;
};
} // namespace hpvi

#endif
