// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/algebra/dense_algebra.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using dealii::types::blas_int;

void multiply(const char op_A, const char op_B, const unsigned int rows, const unsigned int columns,
              const unsigned int inner, const double alpha, const DensePart A, const DensePart B,
              const double beta, double *const C, const unsigned int stride)
{
  const blas_int m = rows, n = columns, k = inner, lda = std::max(A.stride, 1u),
                 ldb = std::max(B.stride, 1u), ldc = stride;
  if (m > 0 && n > 0)
    dealii::gemm(&op_A, &op_B, &m, &n, &k, &alpha, A.entries, &lda, B.entries, &ldb, &beta, C,
                 &ldc);
}

bool cholesky(const unsigned int n, double *const A, const unsigned int stride)
{
  const blas_int size = n, lda = stride;
  blas_int info = 0;
  if (n > 0)
    dealii::potrf("L", &size, A, &lda, &info);
  return info == 0;
}

void solve_triangular(const char op, const unsigned int n, const unsigned int columns,
                      const DensePart L, double *const B, const unsigned int stride)
{
  const blas_int size = n, nrhs = columns, lda = L.stride, ldb = stride;
  blas_int info = 0;
  if (n > 0 && columns > 0)
    dealii::trtrs("L", &op, "N", &size, &nrhs, L.entries, &lda, B, &ldb, &info);
}

PivotedCholesky::PivotedCholesky(const unsigned int n, std::vector<double> A,
                                 const double tolerance)
    : n(n)
{
  std::vector<unsigned int> left(n);
  std::iota(left.begin(), left.end(), 0);
  std::vector<double> columns; // one after the other, each of length n
  double first = 0;
  while (order.size() < n)
  {
    unsigned int pivot = n;
    for (const unsigned int i : left)
      if (pivot == n || A[i * n + i] > A[pivot * n + pivot])
        pivot = i;
    const double diagonal = A[pivot * n + pivot];
    first = order.empty() ? diagonal : first;
    if (!(diagonal > tolerance * first))
      break;
    order.push_back(pivot);
    left.erase(std::find(left.begin(), left.end(), pivot));
    for (unsigned int i = 0; i < n; ++i)
      columns.push_back(A[pivot * n + i] / std::sqrt(diagonal));
    const double *const column = &columns[columns.size() - n];
    for (const unsigned int j : left)
      for (unsigned int i = 0; i < n; ++i) // those of order too, which nothing reads again
        A[j * n + i] -= column[i] * column[j];
  }
  const unsigned int rank = order.size();
  L.assign(rank * rank, 0.);
  for (unsigned int j = 0; j < rank; ++j)
    for (unsigned int i = j; i < rank; ++i)
      L[j * rank + i] = columns[j * n + order[i]];
}

std::vector<double> PivotedCholesky::solve(const std::vector<double> &b) const
{
  const unsigned int rank = order.size();
  std::vector<double> y(rank), x(n);
  for (unsigned int i = 0; i < rank; ++i)
    y[i] = b[order[i]];
  for (const char op : {'N', 'T'})
    solve_triangular(op, rank, 1, {L.data(), rank}, y.data(), rank);
  for (unsigned int i = 0; i < rank; ++i)
    x[order[i]] = y[i];
  return x;
}
} // namespace hpvi
