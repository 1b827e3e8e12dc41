// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/householder.h>
#include <hpvi/solvers/anderson.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int depth = 5; ///< successive x that it makes use of
} // namespace

Vector<double> Anderson::next(const Vector<double> &x, const Vector<double> &f)
{
  if (last_x.size() > 0)
  {
    dx.push_back(x);
    dx.back() -= last_x;
    df.push_back(f);
    df.back() -= last_f;
    Vector<double> change(dx.back());
    change += df.back();
    if (dx.back().l2_norm() > 1e-6 * x.l2_norm()) // else this is round-off
      contraction = std::max(contraction, change.l2_norm() / dx.back().l2_norm());
  }
  if (dx.size() > std::min<std::size_t>(depth, x.size()))
  {
    dx.pop_front();
    df.pop_front();
  }
  last_x = x;
  last_f = f;
  Vector<double> result(x);
  result += f;
  if (df.empty())
    return result;
  FullMatrix<double> matrix(x.size(), df.size());
  for (unsigned int j = 0; j < df.size(); ++j)
    for (unsigned int i = 0; i < x.size(); ++i)
      matrix(i, j) = df[j][i];
  Vector<double> weights(df.size());
  Householder<double>(matrix).least_squares(weights, f);
  // NaN fails too: columns that are as good as dependent
  if (!std::all_of(weights.begin(), weights.end(),
                   [](const double weight) { return std::abs(weight) < 1e3; }))
  {
    dx.clear();
    df.clear();
    return result;
  }
  for (unsigned int j = 0; j < df.size(); ++j)
  {
    result.add(-weights[j], dx[j]);
    result.add(-weights[j], df[j]);
  }
  return result;
}
} // namespace hpvi
