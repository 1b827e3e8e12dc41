// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/block_cholesky.h>
#include <hpvi/algebra/triangular.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
namespace
{
/** `X := L^-1`, n x n by columns with zeros above the diagonal. */
void invert_block(const unsigned int n, const double *const L, const unsigned int stride,
                  double *const X)
{
  std::fill_n(X, n * n, 0.);
  for (unsigned int j = 0; j < n; ++j)
  {
    double *const x = X + j * n;
    x[j] = 1.;
    for (unsigned int k = j; k < n; ++k)
    {
      const double *const column = L + std::size_t(k) * stride;
      x[k] /= column[k];
      for (unsigned int i = k + 1; i < n; ++i)
        x[i] -= x[k] * column[i];
    }
  }
}
} // namespace

// A block takes all that is left of it at once, and multiplies what is below its diagonal part by the inverse of that.
bool BlockCholesky::factor(const unsigned int rows, const unsigned int n, double *const A,
                           const unsigned int stride)
{
  this->n = n;
  L = {A, stride};
  inverses.resize(n * block);
  scratch.resize(rows * block);
  for (unsigned int first = 0; first < n; first += block)
  {
    const unsigned int width = std::min(block, n - first), below = rows - first - width;
    double *const diagonal = A + first + std::size_t(first) * stride, *const inverse =
                                                                          &inverses[first * block];
    if (first > 0)
      multiply('N', 'T', rows - first, width, first, -1., {A + first, stride}, {A + first, stride},
               1., diagonal, stride);
    if (!factor_columns(width, width, diagonal, stride))
      return false;
    invert_block(width, diagonal, stride, inverse);
    for (unsigned int j = 0; j < width; ++j)
      std::copy_n(diagonal + width + std::size_t(j) * stride, below, &scratch[j * below]);
    multiply('N', 'T', below, width, width, 1., {scratch.data(), below}, {inverse, width}, 0.,
             diagonal + width, stride);
  }
  return true;
}

void subtract_square(const unsigned int n, const unsigned int inner, const DensePart A,
                     double *const C, const unsigned int stride)
{
  constexpr unsigned int most_at_once = 20; // beyond it halves with a product are faster
  if (n <= most_at_once)
  {
    multiply('N', 'T', n, n, inner, -1., A, A, 1., C, stride);
    return;
  }
  const unsigned int first = n / 2, second = n - first;
  const DensePart below = {A.entries + first, A.stride};
  subtract_square(first, inner, A, C, stride);
  multiply('N', 'T', second, first, inner, -1., below, A, 1., C + first, stride);
  subtract_square(second, inner, below, C + first + std::size_t(first) * stride, stride);
}
} // namespace hpvi
