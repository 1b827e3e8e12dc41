// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/solver/quadratic_program.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
}

FeasibleSet::FeasibleSet(const Vector<double> &lower, const Vector<double> &upper)
    : lower_bounds(lower), upper_bounds(upper)
{
  AssertThrow(lower.size() == upper.size(), ExcDimensionMismatch(lower.size(), upper.size()));
  // Written so that NaN fails too.
  for (unsigned int i = 0; i < lower.size(); ++i)
    AssertThrow(lower[i] <= upper[i] && lower[i] < infinity && upper[i] > -infinity,
                ExcMessage("The box [" + std::to_string(lower[i]) + ", " +
                           std::to_string(upper[i]) + "] of unknown " + std::to_string(i) +
                           " is empty."));
}

unsigned int FeasibleSet::size() const
{
  return lower_bounds.size();
}

const Vector<double> &FeasibleSet::lower() const
{
  return lower_bounds;
}

const Vector<double> &FeasibleSet::upper() const
{
  return upper_bounds;
}

void FeasibleSet::project(Vector<double> &z) const
{
  AssertDimension(z.size(), size());
  // Comparisons with NaN are false: it passes, and whoever iterates sees it in the gradient.
  for (unsigned int i = 0; i < size(); ++i)
    if (z[i] < lower_bounds[i])
      z[i] = lower_bounds[i];
    else if (z[i] > upper_bounds[i])
      z[i] = upper_bounds[i];
}

double FeasibleSet::distance_to_wall(const Vector<double> &z, const Vector<double> &p) const
{
  AssertDimension(z.size(), size());
  AssertDimension(p.size(), size());
  double alpha = infinity;
  for (unsigned int i = 0; i < size(); ++i)
    if (p[i] > 0)
      alpha = std::min(alpha, (z[i] - lower_bounds[i]) / p[i]);
    else if (p[i] < 0)
      alpha = std::min(alpha, (z[i] - upper_bounds[i]) / p[i]);
  return alpha;
}

void FeasibleSet::split_gradient(const Vector<double> &z, const Vector<double> &r,
                                 Vector<double> &phi, Vector<double> &beta) const
{
  AssertDimension(z.size(), size());
  AssertDimension(r.size(), size());
  phi.reinit(size());
  beta.reinit(size());
  for (unsigned int i = 0; i < size(); ++i)
  {
    const bool at_lower = z[i] <= lower_bounds[i];
    const bool at_upper = z[i] >= upper_bounds[i];
    if (!at_lower && !at_upper)
      phi[i] = r[i];
    else if (at_lower && !at_upper)
      beta[i] = std::min(r[i], 0.);
    else if (at_upper && !at_lower)
      beta[i] = std::max(r[i], 0.);
  }
}

FeasibleSet FeasibleSet::scaled(const Vector<double> &scale) const
{
  AssertDimension(scale.size(), size());
  FeasibleSet result = *this;
  for (unsigned int i = 0; i < size(); ++i)
  {
    Assert(scale[i] > 0, ExcMessage("A scale factor must be positive."));
    result.lower_bounds[i] /= scale[i];
    result.upper_bounds[i] /= scale[i];
  }
  return result;
}

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

Vector<double> diagonal_scale(const LAPACKFullMatrix<double> &S)
{
  AssertDimension(S.m(), S.n());
  double largest = 0;
  for (unsigned int i = 0; i < S.m(); ++i)
    largest = std::max(largest, S(i, i));

  // S is a Gram matrix: rows carry factors g, and S_ii the factor g^2. What is zero to round-off in
  // g is its square in S_ii.
  const double negligible = largest * std::pow(std::numeric_limits<double>::epsilon(), 2) +
                            std::numeric_limits<double>::min();
  Vector<double> scale(S.m());
  for (unsigned int i = 0; i < S.m(); ++i)
    scale[i] = S(i, i) > negligible ? 1. / std::sqrt(S(i, i)) : 1.;
  return scale;
}

LAPACKFullMatrix<double> scaled_by_diagonal(const LAPACKFullMatrix<double> &S)
{
  const Vector<double> scale = diagonal_scale(S);
  LAPACKFullMatrix<double> scaled(S);
  for (unsigned int j = 0; j < S.n(); ++j) // column by column, as LAPACK stores it
    for (unsigned int i = 0; i < S.m(); ++i)
      scaled(i, j) = scale[i] * S(i, j) * scale[j];
  return scaled;
}
} // namespace hpvi
