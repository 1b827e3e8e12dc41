// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_modes_h
#define hpvi_modes_h

#include <vector>

namespace hpvi
{
/**
 * Polynomials in xi, eta on [-1,1]^2 by their Legendre coefficients c(i,j), i and j below n; those of a
 * stress are its components xx, yy, xy in the frame of the cell.
 */
template <unsigned int n_components>
struct Modes
{
  explicit Modes(const unsigned int n = 0) : n(n), coefficients(n_components * n * n)
  {
  }

  double &operator()(const unsigned int k, const unsigned int i, const unsigned int j)
  {
    return coefficients[(k * n + i) * n + j];
  }
  double operator()(const unsigned int k, const unsigned int i, const unsigned int j) const
  {
    return coefficients[(k * n + i) * n + j];
  }

  unsigned int n;
  std::vector<double> coefficients; ///< of one component after the other, j fastest
};

/** Times xi (0) or eta (1); what exceeds the highest mode is dropped. */
template <unsigned int n_components>
Modes<n_components> times(unsigned int variable, const Modes<n_components> &modes);

Modes<2> row(unsigned int k, const Modes<3> &s); ///< of the symmetric tensor

void add(Modes<2> &sum, const Modes<2> &part);
} // namespace hpvi

#endif
