// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/triangular.h>
#include <hpvi/solvers/newton_system.h>

namespace hpvi
{
using namespace dealii;

NewtonSystem::NewtonSystem(const LAPACKFullMatrix<double> &S, const std::vector<unsigned int> &free)
    : free(free), factor(free.size() * free.size())
{
  const std::size_t n = free.size();
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = j; i < n; ++i)
      factor[i + j * n] = S(free[i], free[j]);
  positive_definite = cholesky(n, factor.data(), n);
}

bool NewtonSystem::is_positive_definite() const
{
  return positive_definite;
}

Vector<double> NewtonSystem::solve(const Vector<double> &x) const
{
  Vector<double> result(x.size());
  std::vector<double> change(free.size());
  for (unsigned int j = 0; j < free.size(); ++j)
    change[j] = x[free[j]];
  solve_by_cholesky(free.size(), factor, change.data());
  for (unsigned int j = 0; j < free.size(); ++j)
    result[free[j]] = change[j];
  return result;
}
} // namespace hpvi
