// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/block_factor.h>

#include <algorithm>
#include <cstddef>

namespace hpvi
{
namespace
{
/** Numbers in the block that begins with column @p first: of the square, and of what is below. */
unsigned int width_of(const unsigned int first, const unsigned int n)
{
  return std::min(BlockCholesky::block, n - first);
}

std::size_t size_of(const unsigned int first, const unsigned int n)
{
  return width_of(first, n) * std::size_t(n - first);
}

/** `x := op(X) x` with X lower triangular by columns, n x n. */
void multiply_lower(const bool is_transposed, const unsigned int n, const double *const X,
                    double *const x)
{
  for (unsigned int k = 0; k < n; ++k)
  {
    const unsigned int i = is_transposed ? k : n - 1 - k;
    double sum = 0;
    if (is_transposed)
      for (unsigned int j = i; j < n; ++j)
        sum += X[i * n + j] * x[j];
    else
      for (unsigned int j = 0; j <= i; ++j)
        sum += X[j * n + i] * x[j];
    x[i] = sum;
  }
}
} // namespace

BlockFactor::BlockFactor(const BlockCholesky &cholesky, MatrixPool &pool)
    : size(cholesky.n_columns())
{
  std::size_t n_entries = 0;
  for (unsigned int first = 0; first < size; first += BlockCholesky::block)
    n_entries += size_of(first, size);
  entries = pool.take(n_entries);
  double *to = entries.get();
  for (unsigned int first = 0; first < size; first += BlockCholesky::block)
  {
    const unsigned int width = width_of(first, size);
    to = std::copy_n(cholesky.inverse(first), width * width, to);
    for (unsigned int j = first; j < first + width; ++j)
      to = std::copy(cholesky.column(j) + first + width, cholesky.column(j) + size, to);
  }
}

void BlockFactor::solve(double *const x) const
{
  const double *block = entries.get();
  unsigned int first = 0;
  for (; first < size; first += BlockCholesky::block)
  {
    const unsigned int width = width_of(first, size), next = first + width, below = size - next;
    multiply_lower(/*is_transposed=*/false, width, block, x + first);
    multiply('N', 'N', below, 1, width, -1., {block + width * width, below}, {x + first, width}, 1.,
             x + next, size);
    block += size_of(first, size);
  }
  while (first > 0)
  {
    first -= BlockCholesky::block;
    block -= size_of(first, size);
    const unsigned int width = width_of(first, size), next = first + width, below = size - next;
    multiply('T', 'N', width, 1, below, -1., {block + width * width, below}, {x + next, size}, 1.,
             x + first, size);
    multiply_lower(/*is_transposed=*/true, width, block, x + first);
  }
}
} // namespace hpvi
