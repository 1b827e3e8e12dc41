// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/solver/newton_system.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** a'Sb */
double product(const LAPACKFullMatrix<double> &S, const FeasibleSet::Direction &a,
               const FeasibleSet::Direction &b)
{
  double sum = 0;
  for (unsigned int i = 0; i < a.size; ++i)
    for (unsigned int j = 0; j < b.size; ++j)
      sum += a.weights[i] * S(a.first + i, b.first + j) * b.weights[j];
  return sum;
}
} // namespace

NewtonSystem::NewtonSystem(const LAPACKFullMatrix<double> &S,
                           const std::vector<FeasibleSet::Direction> &directions)
    : directions(directions), factor(directions.size() * directions.size())
{
  const types::blas_int n = directions.size();
  if (n == 0)
    return;
  for (unsigned int j = 0; j < directions.size(); ++j)
  {
    for (unsigned int i = j; i < directions.size(); ++i)
      factor[i + j * directions.size()] = product(S, directions[i], directions[j]);
    factor[j + j * directions.size()] += directions[j].curvature;
  }
  types::blas_int info = 0;
  potrf("L", &n, factor.data(), &n, &info);
  positive_definite = info == 0;
}

bool NewtonSystem::is_positive_definite() const
{
  return positive_definite;
}

Vector<double> NewtonSystem::solve(const Vector<double> &x) const
{
  Vector<double> result(x.size());
  const types::blas_int n = directions.size(), one = 1;
  if (n == 0)
    return result;
  std::vector<double> change(directions.size());
  for (unsigned int j = 0; j < directions.size(); ++j)
    for (unsigned int k = 0; k < directions[j].size; ++k)
      change[j] += directions[j].weights[k] * x[directions[j].first + k];
  types::blas_int info = 0;
  potrs("L", &n, &one, factor.data(), &n, change.data(), &n, &info);
  for (unsigned int j = 0; j < directions.size(); ++j)
    for (unsigned int k = 0; k < directions[j].size; ++k)
      result[directions[j].first + k] += directions[j].weights[k] * change[j];
  return result;
}
} // namespace hpvi
