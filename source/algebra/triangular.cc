// SPDX-License-Identifier: LGPL-2.1-or-later

// Where matrices have some ten to hundred rows, LAPACK's factorisation takes up to twice as long as a few loops and products, and
// OpenBLAS's solutions for few columns do at any size; for one column they wait for a buffer that all threads share.
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/algebra/triangular.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hpvi
{
using dealii::types::blas_int;

bool factor_columns(const unsigned int n, const unsigned int width, double *const A,
                    const unsigned int stride)
{
  for (unsigned int j = 0; j < width; ++j)
  {
    double *const column = A + std::size_t(j) * stride;
    if (!(column[j] > 0.))
      return false;
    column[j] = std::sqrt(column[j]);
    const double scale = 1. / column[j];
    for (unsigned int i = j + 1; i < n; ++i)
      column[i] *= scale;
    for (unsigned int k = j + 1; k < width; ++k)
    {
      double *const other = A + std::size_t(k) * stride;
      const double factor = column[k];
      for (unsigned int i = k; i < n; ++i)
        other[i] -= factor * column[i];
    }
  }
  return true;
}

namespace
{
/** So many columns at a time are taken entry by entry, of one or of several vectors; what they do to the others are products. */
constexpr unsigned int block = 16, narrow = 8;

/** From an entry of the diagonal on: columns with their stride, as far as a panel of sixteen goes. */
using Columns = std::pair<double *, unsigned int>;

/** @p from: Columns of A from an entry of its diagonal on. */
template <class From>
bool factor(const unsigned int n, const From &from)
{
  for (unsigned int first = 0; first < n; first += narrow)
  {
    const unsigned int width = std::min(narrow, n - first);
    const Columns columns = from(first);
    if (!factor_columns(n - first, width, columns.first, columns.second))
      return false;
    for (unsigned int k = first + width, next; k < n; k = next)
    {
      next = std::min(n, (k / block + 1) * block);
      const DensePart below{columns.first + (k - first), columns.second};
      const Columns target = from(k);
      multiply('N', 'T', n - k, next - k, width, -1., below, below, 1., target.first,
               target.second);
    }
  }
  return true;
}

/** B := L^-1 B, @p from: parts of L from an entry of its diagonal on. */
template <class From>
void solve_forward(const unsigned int n, const unsigned int columns, const From &from,
                   double *const B, const unsigned int stride)
{
  const unsigned int grain = columns == 1 ? block : narrow;
  for (unsigned int first = 0; first < n; first += grain)
  {
    const unsigned int width = std::min(n - first, grain);
    const DensePart L = from(first);
    for (unsigned int k = 0; k < columns; ++k)
    {
      double *const x = B + std::size_t(k) * stride + first;
      for (unsigned int j = 0; j < width; ++j)
      {
        const double *const column = L.entries + std::size_t(j) * L.stride;
        const double value = x[j] /= column[j];
        for (unsigned int i = j + 1; i < width; ++i)
          x[i] -= column[i] * value;
      }
    }
    multiply('N', 'N', n - first - width, columns, width, -1., {L.entries + width, L.stride},
             {B + first, stride}, 1., B + first + width, stride);
  }
}

/** x := L^-T x */
template <class From>
void solve_backward(const unsigned int n, const From &from, double *const x)
{
  for (unsigned int end = n, first; end > 0; end = first)
  {
    first = (end - 1) / block * block;
    const unsigned int width = end - first;
    const DensePart L = from(first);
    double *const own = x + first;
    multiply('T', 'N', width, 1, n - end, -1., {L.entries + width, L.stride}, {x + end, n}, 1., own,
             n);
    for (unsigned int j = width; j-- > 0;)
    {
      const double *const column = L.entries + std::size_t(j) * L.stride;
      for (unsigned int i = j + 1; i < width; ++i)
        own[j] -= column[i] * own[i];
      own[j] /= column[j];
    }
  }
}
} // namespace

bool cholesky(const unsigned int n, double *const A, const unsigned int stride)
{
  constexpr unsigned int large = 160;
  if (n <= large)
    return factor(n, [&](const unsigned int k)
                  { return Columns(A + std::size_t(k) * (stride + 1), stride); });
  const blas_int size = n, lda = stride;
  blas_int info = 0;
  dealii::potrf("L", &size, A, &lda, &info);
  for (unsigned int i = 0; info == 0 && i < n; ++i) // OpenBLAS goes on with what is no number
    info = A[std::size_t(i) * (stride + 1)] > 0. ? 0 : 1;
  return info == 0;
}

void solve_triangular(const char op, const unsigned int n, const unsigned int columns,
                      const DensePart L, double *const B, const unsigned int stride)
{
  const auto from = [&](const unsigned int k) {
    return DensePart{L.entries + std::size_t(k) * (L.stride + 1), L.stride};
  };
  const blas_int size = n, nrhs = columns, lda = L.stride, ldb = stride;
  blas_int info = 0;
  if (op == 'N')
    solve_forward(n, columns, from, B, stride);
  else if (columns == 1)
    solve_backward(n, from, B);
  else if (n > 0 && columns > 0)
    dealii::trtrs("L", &op, "N", &size, &nrhs, L.entries, &lda, B, &ldb, &info);
}

void solve_by_cholesky(const unsigned int n, const std::vector<double> &L, double *const x)
{
  for (const char op : {'N', 'T'})
    solve_triangular(op, n, 1, {L.data(), n}, x, n);
}

PackedTriangle::PackedTriangle(const unsigned int n)
    : n(n), entries(n == 0 ? 0 : place(n - 1) + n - (n - 1) / block * block)
{
}

/** Of entry (f, j), f the first row of the panel of column j. */
std::size_t PackedTriangle::place(const unsigned int j) const
{
  const std::size_t first = j / block * block, before = first / block;
  return block * (before * n - block * (before * (before - 1)) / 2) + (j - first) * (n - first);
}

double *PackedTriangle::column(const unsigned int j)
{
  return entries.data() + place(j) - j / block * block;
}

const double *PackedTriangle::column(const unsigned int j) const
{
  return entries.data() + place(j) - j / block * block;
}

bool PackedTriangle::factor()
{
  return hpvi::factor(n, [&](const unsigned int k)
                      { return Columns(column(k) + k, n - k / block * block); });
}

void PackedTriangle::solve(const char op, const unsigned int columns, double *const B,
                           const unsigned int stride) const
{
  const auto from = [&](const unsigned int k) {
    return DensePart{column(k) + k, n - k / block * block};
  };
  if (op == 'N')
    solve_forward(n, columns, from, B, stride);
  else
    solve_backward(n, from, B);
}
} // namespace hpvi
