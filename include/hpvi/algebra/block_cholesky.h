// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_block_cholesky_h
#define hpvi_block_cholesky_h

#include <hpvi/algebra/dense_algebra.h>

#include <cstddef>
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
  /** Columns of a block. Fewer leave less to substitution, more make larger products: measured with 18 to 98 unknowns. */
  static constexpr unsigned int block = 8;

  /**
   * The first @p n columns of the lower triangle, of @p rows >= n rows, become those of L; what is above the diagonal is lost. Is
   * their square positive definite? A must outlive what follows.
   */
  bool factor(unsigned int rows, unsigned int n, double *A, unsigned int stride);

  unsigned int n_columns() const
  {
    return n;
  }

  /** The inverse of the diagonal part of the block that begins with column @p first, by columns; the last block may be narrower. */
  const double *inverse(const unsigned int first) const
  {
    return &inverses[first * block];
  }

  /** Of L; above the diagonal there is none of it. */
  const double *column(const unsigned int j) const
  {
    return L.entries + std::size_t(j) * L.stride;
  }

private:
  unsigned int n = 0;
  DensePart L{};
  std::vector<double> inverses, scratch; ///< keep their memory
};

/** `C := C - A A'` in the lower triangle of C, n x n, of which entries above it are lost; A n x inner. */
void subtract_square(unsigned int n, unsigned int inner, DensePart A, double *C,
                     unsigned int stride);
} // namespace hpvi

#endif
