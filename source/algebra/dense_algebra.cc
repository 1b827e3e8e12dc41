// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/algebra/dense_algebra.h>
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

bool cholesky(const unsigned int n, double *const A, const unsigned int stride)
{
  const blas_int size = n, lda = stride;
  blas_int info = 0;
  if (n > 0)
    dealii::potrf("L", &size, A, &lda, &info);
  return info == 0;
}

void require_regular(const bool is_positive_definite, const char *const what)
{
  if (!is_positive_definite)
    throw NumericalFailure(std::string("round-off spoils ") + what +
                           ", as where it is many thousand times as long as wide");
}

namespace
{
/** So many columns at a time are solved for entry by entry; what they do to the others is one product. */
constexpr unsigned int block = 16;

/** x := L^-1 x */
void solve_forward(const unsigned int n, const DensePart L, double *const x)
{
  for (unsigned int first = 0; first < n; first += block)
  {
    const unsigned int end = std::min(n, first + block);
    for (unsigned int j = first; j < end; ++j)
    {
      const double *const column = L.entries + std::size_t(j) * L.stride;
      x[j] /= column[j];
      for (unsigned int i = j + 1; i < end; ++i)
        x[i] -= column[i] * x[j];
    }
    multiply('N', 'N', n - end, 1, end - first, -1.,
             {L.entries + std::size_t(first) * L.stride + end, L.stride}, {x + first, n}, 1.,
             x + end, n);
  }
}

/** x := L^-T x */
void solve_backward(const unsigned int n, const DensePart L, double *const x)
{
  for (unsigned int end = n, first; end > 0; end = first)
  {
    first = (end - 1) / block * block;
    multiply('T', 'N', end - first, 1, n - end, -1.,
             {L.entries + std::size_t(first) * L.stride + end, L.stride}, {x + end, n}, 1.,
             x + first, n);
    for (unsigned int j = end; j-- > first;)
    {
      const double *const column = L.entries + std::size_t(j) * L.stride;
      for (unsigned int i = j + 1; i < end; ++i)
        x[j] -= column[i] * x[i];
      x[j] /= column[j];
    }
  }
}
} // namespace

// For one column OpenBLAS's own takes a buffer that all threads share, and up to four times as long.
void solve_triangular(const char op, const unsigned int n, const unsigned int columns,
                      const DensePart L, double *const B, const unsigned int stride)
{
  const blas_int size = n, nrhs = columns, lda = L.stride, ldb = stride;
  blas_int info = 0;
  if (columns == 1)
    (op == 'N' ? solve_forward : solve_backward)(n, L, B);
  else if (n > 0 && columns > 0)
    dealii::trtrs("L", &op, "N", &size, &nrhs, L.entries, &lda, B, &ldb, &info);
}

void solve_by_cholesky(const unsigned int n, const std::vector<double> &L, double *const x)
{
  for (const char op : {'N', 'T'})
    solve_triangular(op, n, 1, {L.data(), n}, x, n);
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
