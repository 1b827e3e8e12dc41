// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/solvers/quadratic_program.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hpvi
{
using namespace dealii;

void QuadraticProgram::assert_size([[maybe_unused]] const Vector<double> &z) const
{
  AssertDimension(S.n(), z.size());
  AssertDimension(d.size(), z.size());
  AssertDimension(feasible_set.size(), z.size());
}

double condition_number(const LAPACKFullMatrix<double> &S)
{
  AssertDimension(S.m(), S.n());
  const types::blas_int n = S.n();
  if (n == 0)
    return 1.;

  // dsyev with 'N' stops at the eigenvalues, an order of magnitude before the eigenvectors that
  // LAPACKFullMatrix::compute_eigenvalues_symmetric() would add.
  LAPACKFullMatrix<double> factor(S);
  std::vector<double> eigenvalues(n);
  const types::blas_int work_size = 34 * n; // block size 32 + 2
  std::vector<double> work(work_size);
  types::blas_int info = 0;
  syev("N", "L", &n, &factor(0, 0), &n, eigenvalues.data(), work.data(), &work_size, &info);

  const double smallest = eigenvalues.front(), largest = eigenvalues.back();
  if (info != 0 || std::isnan(smallest) || std::isnan(largest))
    return std::numeric_limits<double>::quiet_NaN();
  return smallest > 0 ? largest / smallest : infinity;
}

std::vector<std::pair<double, Vector<double>>> eigenpairs(const FullMatrix<double> &matrix)
{
  const types::blas_int n = matrix.m(), work_size = 34 * std::max<types::blas_int>(1, n);
  LAPACKFullMatrix<double> vectors(n);
  vectors = matrix;
  std::vector<double> eigenvalues(n), work(work_size);
  types::blas_int info = 0;
  if (n > 0)
    syev("V", "L", &n, &vectors(0, 0), &n, eigenvalues.data(), work.data(), &work_size, &info);
  AssertThrow(info == 0, ExcInternalError());
  std::vector<std::pair<double, Vector<double>>> result;
  for (unsigned int k = matrix.m(); k-- > 0;)
  {
    result.emplace_back(eigenvalues[k], Vector<double>(matrix.m()));
    for (unsigned int i = 0; i < matrix.m(); ++i)
      result.back().second[i] = vectors(i, k);
  }
  return result;
}

Vector<double> diagonal_scale(const LAPACKFullMatrix<double> &S)
{
  AssertDimension(S.m(), S.n());
  double largest = 0;
  for (unsigned int i = 0; i < S.m(); ++i)
    largest = std::max(largest, S(i, i));

  // S is a Gram matrix: rows carry the weights w of their points, and S_ii their squares. What is
  // zero to round-off in w is its square in S_ii.
  const double negligible = largest * std::pow(std::numeric_limits<double>::epsilon(), 2) +
                            std::numeric_limits<double>::min();
  Vector<double> scale(S.m());
  for (unsigned int i = 0; i < S.m(); ++i)
    scale[i] = S(i, i) > negligible ? 1. / std::sqrt(S(i, i)) : 1.;
  return scale;
}

LAPACKFullMatrix<double> scaled(const LAPACKFullMatrix<double> &S, const Vector<double> &scale)
{
  LAPACKFullMatrix<double> scaled(S);
  for (unsigned int j = 0; j < S.n(); ++j) // column by column, as LAPACK stores it
    for (unsigned int i = 0; i < S.m(); ++i)
      scaled(i, j) = scale[i] * S(i, j) * scale[j];
  return scaled;
}

LAPACKFullMatrix<double> scaled_by_diagonal(const LAPACKFullMatrix<double> &S)
{
  return scaled(S, diagonal_scale(S));
}
} // namespace hpvi
