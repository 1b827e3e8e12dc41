// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_newton_system_h
#define hpvi_newton_system_h

#include <deal.II/lac/lapack_full_matrix.h>
#include <hpvi/solver/feasible_set.h>

#include <vector>

namespace hpvi
{
/**
 * Newton's equations for `r = 0` along the directions Q that a prediction leaves free: the Cholesky
 * factor of `Q'SQ + C`, C the curvatures of the rims. Refers to the directions as long as it lives.
 */
class NewtonSystem
{
public:
  NewtonSystem(const dealii::LAPACKFullMatrix<double> &S,
               const std::vector<FeasibleSet::Direction> &directions);

  bool is_positive_definite() const; ///< to round-off; nothing else may be asked unless it is

  /** `Q (Q'SQ + C)^-1 Q'x` */
  dealii::Vector<double> solve(const dealii::Vector<double> &x) const;

private:
  const std::vector<FeasibleSet::Direction> &directions;
  std::vector<double> factor; ///< lower triangle by columns
  bool positive_definite = true;
};
} // namespace hpvi

#endif
