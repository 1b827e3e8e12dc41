// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/legendre.h>
#include <hpvi/bound/modes.h>

#include <algorithm>

namespace hpvi
{
template <unsigned int n_components>
Modes<n_components> times(const unsigned int variable, const Modes<n_components> &modes)
{
  const unsigned int n = modes.n, step = variable == 0 ? n : 1, other_step = n + 1 - step;
  Modes<n_components> result(n);
  for (unsigned int power = 0; power + 1 < n; ++power)
  {
    const double shift = legendre::shift(power + 1);
    for (unsigned int k = 0; k < n_components; ++k)
    {
      const double *const from = &modes.coefficients[k * n * n + power * step];
      double *const to = &result.coefficients[k * n * n + power * step];
      for (unsigned int i = 0; i < n * other_step; i += other_step)
      {
        to[i + step] += shift * from[i];
        to[i] += shift * from[i + step];
      }
    }
  }
  return result;
}

Modes<2> row(const unsigned int k, const Modes<3> &s)
{
  const unsigned int size = s.n * s.n;
  Modes<2> result(s.n);
  for (const unsigned int c : {0, 1})
  {
    const auto from = s.coefficients.begin() + size * (k == c ? k : 2);
    std::copy(from, from + size, result.coefficients.begin() + size * c);
  }
  return result;
}

void add(Modes<2> &sum, const Modes<2> &part)
{
  for (unsigned int k = 0; k < 2; ++k)
    for (unsigned int i = 0; i < std::min(sum.n, part.n); ++i)
      for (unsigned int j = 0; j < std::min(sum.n, part.n); ++j)
        sum(k, i, j) += part(k, i, j);
}

template Modes<2> times(unsigned int, const Modes<2> &);
template Modes<3> times(unsigned int, const Modes<3> &);
} // namespace hpvi
