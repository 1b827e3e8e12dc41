// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_block_cholesky_h
#define hpvi_block_cholesky_h

#include <hpvi/algebra/dense_algebra.h>

#include <vector>

namespace hpvi
{
/**
 * Elimination of the first unknowns of a symmetric matrix of some hundred rows, `A = L L'` in blocks of columns whose diagonal
 * parts are inverted: all but these is products, several times as fast as factorisation and substitution of OpenBLAS at
 * this size.
 */
class BlockCholesky
{
public:
  /**
   * The first @p n columns of the lower triangle, of @p rows >= n rows, become those of L; what is above the diagonal is lost. Is
   * their square positive definite? A must outlive what follows.
   */
  bool factor(unsigned int rows, unsigned int n, double *A, unsigned int stride);

  /** `E := -W L^-1` with L the n x n part and W the rows of the factor below it; @p E by columns, (rows - n) x n. */
  void extend(double *E);

private:
  unsigned int rows = 0, n = 0;
  DensePart L{};
  std::vector<double> inverses, scratch; ///< keep their memory
};

/** `C := C - A A'` in the lower triangle of C, n x n, of which entries above it are lost; A n x inner. */
void subtract_square(unsigned int n, unsigned int inner, DensePart A, double *C,
                     unsigned int stride);
} // namespace hpvi

#endif
