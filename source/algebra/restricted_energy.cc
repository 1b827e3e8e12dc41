// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/restricted_energy.h>
#include <hpvi/base/numbers.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

double BorderedMatrix::energy(const unsigned int column, const Vector<double> &x) const
{
  double sum = 0;
  for_each_entry(column, [&](const unsigned int row, const double value)
                 { sum += (row == column ? 1. : 2.) * value * x[row]; });
  return sum * x[column];
}

double BorderedMatrix::energy(const Vector<double> &x) const
{
  double result = 0;
  for (unsigned int column = 0; column < n(); ++column)
    if (x[column] != 0.)
      result += energy(column, x);
  return result;
}

RestrictedEnergy::RestrictedEnergy(const BorderedMatrix &A, const std::vector<bool> &is_free,
                                   const Vector<double> &fixed, std::vector<unsigned int> all_kept)
    : fixed(fixed)
{
  std::vector<unsigned int> number(A.n(), none);
  for (unsigned int i = 0; i < A.n(); ++i)
    if (is_free[i])
    {
      number[i] = free.size();
      free.push_back(i);
    }
  Vector<double> f(free.size());
  const SymmetricMatrix A_ff = restrict(A, number, f);
  std::sort(all_kept.begin(), all_kept.end());
  std::vector<unsigned int> numbers;
  for (const unsigned int unknown : all_kept)
    numbers.push_back(number[unknown]);
  solver = std::make_unique<const LinearSolver>(A_ff, numbers);
  for (const unsigned int k : solver->interface_order())
    interface.push_back(all_kept[k]);
  y = solver->forward(f);
}

/** The block of the free unknowns, and what the fixed ones do to them. */
SymmetricMatrix RestrictedEnergy::restrict(const BorderedMatrix &A,
                                           const std::vector<unsigned int> &number,
                                           Vector<double> &f) const
{
  SymmetricMatrix A_ff;
  for (unsigned int column = 0; column < A.n(); ++column)
  {
    const unsigned int own = number[column];
    if (own == none && fixed[column] == 0.)
      continue;
    A.for_each_entry(column,
                     [&](const unsigned int row, const double value)
                     {
                       const unsigned int other = number[row];
                       if (own != none && other != none)
                       {
                         A_ff.row.push_back(other);
                         // Where contact alone holds the body, A is singular; x need not be the
                         // minimiser to be of use.
                         A_ff.value.push_back(value * (row == column ? 1. + 1e-10 : 1.));
                       }
                       else if (own != none)
                         f[own] -= value * fixed[row];
                       else if (other != none)
                         f[other] -= value * fixed[column];
                     });
    if (own != none)
      A_ff.column_start.push_back(A_ff.row.size());
  }
  return A_ff;
}

unsigned int RestrictedEnergy::place(const unsigned int unknown) const
{
  const auto found = std::find(interface.begin(), interface.end(), unknown);
  return found == interface.end() ? none : found - interface.begin();
}

unsigned int RestrictedEnergy::n_kept() const
{
  return interface.size();
}

FullMatrix<double> RestrictedEnergy::H() const
{
  const LAPACKFullMatrix<double> &C = solver->kept_factor();
  FullMatrix<double> result(interface.size(), interface.size());
  for (unsigned int i = 0; i < interface.size(); ++i)
    for (unsigned int j = 0; j <= i; ++j)
    {
      for (unsigned int k = 0; k <= j; ++k)
        result(i, j) += C(i, k) * C(j, k);
      result(j, i) = result(i, j);
    }
  return result;
}

Vector<double> RestrictedEnergy::h() const
{
  const LAPACKFullMatrix<double> &C = solver->kept_factor();
  Vector<double> result(interface.size());
  for (unsigned int i = 0; i < interface.size(); ++i)
    for (unsigned int k = 0; k <= i; ++k)
      result[i] += C(i, k) * y[y.size() - interface.size() + k];
  return result;
}

Vector<double> RestrictedEnergy::minimiser() const
{
  return all(y);
}

Vector<double> RestrictedEnergy::minimiser(const Vector<double> &interface_values) const
{
  const LAPACKFullMatrix<double> &C = solver->kept_factor();
  Vector<double> changed(y);
  for (unsigned int k = 0; k < interface.size(); ++k)
  {
    double &entry = changed[y.size() - interface.size() + k];
    entry = 0.;
    for (unsigned int i = k; i < interface.size(); ++i)
      entry += C(i, k) * interface_values[i];
  }
  return all(changed);
}

Vector<double> RestrictedEnergy::all(const Vector<double> &forwarded) const
{
  const Vector<double> values = solver->backward(forwarded);
  Vector<double> x(fixed);
  for (unsigned int i = 0; i < free.size(); ++i)
    x[free[i]] = values[i];
  return x;
}

} // namespace hpvi
