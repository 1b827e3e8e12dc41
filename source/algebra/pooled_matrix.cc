// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/vector.h>
#include <hpvi/algebra/pooled_matrix.h>
#include <hpvi/base/memory.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <numeric>
#include <utility>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr std::size_t piece_size = 2 * large_page / sizeof(double);

/** Aligned for large pages, @p n numbers or some more. */
std::unique_ptr<double, decltype(&std::free)> allocate(const std::size_t n)
{
  const std::size_t bytes = (n * sizeof(double) + large_page - 1) / large_page * large_page;
  void *const memory = std::aligned_alloc(large_page, bytes);
  if (!memory)
    throw std::bad_alloc();
  want_large_pages(memory, bytes);
  return {static_cast<double *>(memory), std::free};
}
} // namespace

/** Those that are empty. */
class MatrixPool::Pieces
{
public:
  static std::shared_ptr<double> take(const std::shared_ptr<Pieces> &all)
  {
    if (all->empty.empty())
      all->empty.push_back(allocate(piece_size));
    std::unique_ptr<double, decltype(&std::free)> one = std::move(all->empty.back());
    all->empty.pop_back();
    all->empty.reserve(all->empty.size() + ++all->n_taken); // to give it back cannot fail
    return {one.release(), [all](double *const entries)
            {
              all->empty.emplace_back(entries, std::free);
              --all->n_taken;
            }};
  }

private:
  std::vector<std::unique_ptr<double, decltype(&std::free)>> empty;
  std::size_t n_taken = 0;
};

MatrixPool::MatrixPool() : pieces(std::make_shared<Pieces>())
{
}

std::shared_ptr<double> MatrixPool::take(const std::size_t n)
{
  constexpr std::size_t line = 8; // numbers in a line of the cache
  const std::size_t needed = (n + line - 1) / line * line;
  taken += needed;
  if (taken < piece_size || needed > piece_size / 4)
    return {new double[needed], std::default_delete<double[]>()};
  if (needed > left)
  {
    piece = Pieces::take(pieces);
    left = piece_size;
  }
  left -= needed;
  return {piece, piece.get() + left};
}

PooledMatrix::PooledMatrix(const FullMatrix<double> &matrix)
    : entries(new double[matrix.n_elements()], std::default_delete<double[]>()), n_rows(matrix.m()),
      n_columns(matrix.n())
{
  for (unsigned int i = 0; i < n_rows; ++i)
    std::copy_n(&matrix(i, 0), n_columns, row(i));
}

PooledMatrix::PooledMatrix(const unsigned int m, const unsigned int n, MatrixPool &pool)
    : entries(pool.take(std::size_t(m) * n)), n_rows(m), n_columns(n)
{
}

void PooledMatrix::vmult(Vector<double> &y, const Vector<double> &x) const
{
  for (unsigned int i = 0; i < n_rows; ++i)
    y[i] = std::inner_product(row(i), row(i) + n_columns, x.begin(), 0.);
}

void PooledMatrix::Tvmult(Vector<double> &y, const Vector<double> &x) const
{
  y = 0.;
  for (unsigned int i = 0; i < n_rows; ++i)
  {
    const double *const values = row(i);
    const double factor = x[i];
    for (unsigned int j = 0; j < n_columns; ++j)
      y[j] += factor * values[j];
  }
}

double PooledMatrix::matrix_norm_square(const Vector<double> &x) const
{
  double sum = 0;
  for (unsigned int i = 0; i < n_rows; ++i)
    sum += x[i] * std::inner_product(row(i), row(i) + n_columns, x.begin(), 0.);
  return sum;
}

FullMatrix<double> PooledMatrix::full() const
{
  return FullMatrix<double>(n_rows, n_columns, entries.get());
}
} // namespace hpvi
