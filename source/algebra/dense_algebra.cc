// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/algebra/triangular.h>
#include <hpvi/base/numerical_failure.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace hpvi
{
using dealii::types::blas_int;

double dot(const dealii::Vector<double> &a, const dealii::Vector<double> &b)
{
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
}

double sum(const std::vector<double> &values)
{
  return std::accumulate(values.begin(), values.end(), 0.);
}

void multiply(const char op_A, const char op_B, const unsigned int rows, const unsigned int columns,
              const unsigned int inner, const double alpha, const DensePart A, const DensePart B,
              const double beta, double *const C, const unsigned int stride)
{
  const blas_int m = rows, n = columns, k = inner, lda = std::max(A.stride, 1u),
                 ldb = std::max(B.stride, 1u), ldc = stride;
  if (m == 0 || n == 0)
    return;
  const blas_int one = 1, rows_A = op_A == 'N' ? m : k, columns_A = op_A == 'N' ? k : m;
  if (n == 1 && op_B == 'N')
    dealii::gemv(&op_A, &rows_A, &columns_A, &alpha, A.entries, &lda, B.entries, &one, &beta, C,
                 &one);
  else
    dealii::gemm(&op_A, &op_B, &m, &n, &k, &alpha, A.entries, &lda, B.entries, &ldb, &beta, C,
                 &ldc);
}

void require_regular(const bool is_positive_definite, const char *const what)
{
  if (!is_positive_definite)
    throw NumericalFailure(std::string("round-off spoils ") + what +
                           ", as where it is many thousand times as long as wide");
}

PivotedCholesky::PivotedCholesky(const unsigned int n, const std::vector<double> &A,
                                 const double tolerance)
    : n(n)
{
  std::vector<double> diagonal(n), row(n), columns; // those of L, of length n in the order of A
  for (unsigned int i = 0; i < n; ++i)
    diagonal[i] = A[i * n + i];
  columns.reserve(A.size());
  double first = 0;
  while (order.size() < n)
  {
    const unsigned int pivot =
        std::max_element(diagonal.begin(), diagonal.end()) - diagonal.begin();
    first = order.empty() ? diagonal[pivot] : first;
    if (!(diagonal[pivot] > tolerance * first))
      break;
    const unsigned int k = order.size();
    columns.insert(columns.end(), &A[pivot * n], &A[pivot * n] + n);
    double *const column = &columns[k * n];
    for (unsigned int j = 0; j < k; ++j)
      row[j] = columns[j * n + pivot];
    multiply('N', 'N', n, 1, k, -1., {columns.data(), n}, {row.data(), k}, 1., column, n);
    const double scale = 1 / std::sqrt(diagonal[pivot]);
    for (unsigned int i = 0; i < n; ++i)
    {
      column[i] *= scale;
      diagonal[i] -= column[i] * column[i];
    }
    diagonal[pivot] = -std::numeric_limits<double>::infinity(); // not again
    order.push_back(pivot);
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

LuFactor::LuFactor(std::vector<double> matrix, const unsigned int n)
    : factor(std::move(matrix)), pivots(n), n(n)
{
  if (n == 0 ||
      !std::all_of(factor.begin(), factor.end(), [](const double x) { return std::isfinite(x); }))
    return;
  blas_int info = 0;
  dealii::getrf(&this->n, &this->n, factor.data(), &this->n, pivots.data(), &info);
  // L, with 1 on its diagonal and nothing larger below, is well conditioned.
  std::vector<double> work(3 * n);
  std::vector<blas_int> integers(n);
  dealii::trcon("1", "U", "N", &this->n, factor.data(), &this->n, &reciprocal_condition,
                work.data(), integers.data(), &info);
}

bool LuFactor::is_singular() const
{
  return !(n == 0 || reciprocal_condition > 1e-14);
}

void LuFactor::solve(std::vector<double> &x) const
{
  const blas_int one = 1;
  blas_int info = 0;
  if (n > 0)
    dealii::getrs("N", &n, &one, factor.data(), &n, pivots.data(), x.data(), &n, &info);
}
} // namespace hpvi
