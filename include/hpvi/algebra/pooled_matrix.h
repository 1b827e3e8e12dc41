// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_pooled_matrix_h
#define hpvi_pooled_matrix_h

#include <deal.II/lac/full_matrix.h>

#include <cstddef>
#include <memory>

namespace hpvi
{
/**
 * Memory of many matrices, in pieces of megabytes that Linux may map by large pages: to touch small ones for the first time
 * takes as long as half of what is done with them. Few matrices have no piece. One that nothing is in any more is taken again, and
 * goes when the pool and all that is in its pieces have gone.
 */
class MatrixPool
{
public:
  MatrixPool();

  /** Room for @p n numbers, which are not set. */
  std::shared_ptr<double> take(std::size_t n);

private:
  class Pieces;
  const std::shared_ptr<Pieces> pieces;
  std::shared_ptr<double> piece;
  std::size_t taken = 0, left = 0;
};

/** A dense matrix by rows, in memory of its own or beside others. Copies share it. */
class PooledMatrix
{
public:
  PooledMatrix() = default;
  explicit PooledMatrix(const dealii::FullMatrix<double> &matrix);
  PooledMatrix(unsigned int m, unsigned int n, MatrixPool &pool); ///< entries are not set

  unsigned int m() const
  {
    return n_rows;
  }
  unsigned int n() const
  {
    return n_columns;
  }
  double *row(const unsigned int i)
  {
    return entries.get() + std::size_t(i) * n_columns;
  }
  const double *row(const unsigned int i) const
  {
    return entries.get() + std::size_t(i) * n_columns;
  }

  void vmult(dealii::Vector<double> &y, const dealii::Vector<double> &x) const;  ///< y := A x
  void Tvmult(dealii::Vector<double> &y, const dealii::Vector<double> &x) const; ///< y := A' x
  double matrix_norm_square(const dealii::Vector<double> &x) const;              ///< x' A x
  dealii::FullMatrix<double> full() const;

private:
  std::shared_ptr<double> entries;
  unsigned int n_rows = 0, n_columns = 0;
};
} // namespace hpvi

#endif
