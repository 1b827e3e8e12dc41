// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_dense_elimination_h
#define hpvi_dense_elimination_h

#include <gtest/gtest.h>
#include <hpvi/plane/condensation.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace verification
{
/** The inverse of the interior block of K by Gauss and Jordan, and what it makes of K: unknowns on the boundary come first. */
struct DenseElimination
{
  dealii::FullMatrix<double> inverse, condensed, extension;

  DenseElimination(const dealii::FullMatrix<double> &K, const unsigned int n_b)
      : condensed(n_b, n_b)
  {
    const unsigned int n_i = K.m() - n_b;
    condensed.fill(K);
    if (n_i == 0)
      return;
    dealii::FullMatrix<double> K_ib(n_i, n_b), K_bi(n_b, n_i);
    inverse.reinit(n_i, n_i);
    extension.reinit(n_i, n_b);
    inverse.fill(K, 0, 0, n_b, n_b);
    K_ib.fill(K, 0, 0, n_b, 0);
    K_bi.fill(K, 0, 0, 0, n_b);
    inverse.gauss_jordan();
    inverse.mmult(extension, K_ib);
    extension *= -1.;
    K_bi.mmult(condensed, extension, true);
  }
};

inline double largest_difference(dealii::FullMatrix<double> A, const dealii::FullMatrix<double> &B)
{
  EXPECT_EQ(A.m(), B.m());
  EXPECT_EQ(A.n(), B.n());
  A.add(-1., B);
  double largest = 0;
  for (unsigned int i = 0; i < A.m(); ++i)
    for (unsigned int j = 0; j < A.n(); ++j)
      largest = std::max(largest, std::abs(A(i, j)));
  return largest;
}

/** Where loads act inside cells: what is left of K, to @p tolerance of K, and what is kept of its interior. */
inline void expect_condensed(const hpvi::CondensedElement &element,
                             const dealii::FullMatrix<double> &K, const unsigned int n_b,
                             const double tolerance)
{
  const DenseElimination dense(K, n_b);
  EXPECT_LE(largest_difference(element.condensed, dense.condensed), tolerance * K.linfty_norm());
  const unsigned int n_i = K.m() - n_b;
  ASSERT_EQ(element.n_interior, n_i);
  if (n_i == 0)
    return;
  if (!element.extension.empty())
  {
    EXPECT_LE(largest_difference(element.extension, dense.extension),
              1e-11 * dense.extension.linfty_norm());
  }
  dealii::FullMatrix<double> inverse(n_i, n_i);
  for (unsigned int j = 0; j < n_i; ++j)
  {
    std::vector<double> x(n_i, 0.);
    x[j] = 1.;
    element.solve_inside(x.data());
    for (unsigned int i = 0; i < n_i; ++i)
      inverse(i, j) = x[i];
  }
  EXPECT_LE(largest_difference(inverse, dense.inverse), 1e-11 * dense.inverse.linfty_norm());
}
} // namespace verification

#endif
