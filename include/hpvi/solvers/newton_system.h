// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_newton_system_h
#define hpvi_newton_system_h

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace hpvi
{
/** Newton's equations for `r = 0` at the components F that a prediction leaves free: the Cholesky factor of S_FF. */
class NewtonSystem
{
public:
  NewtonSystem(const dealii::LAPACKFullMatrix<double> &S, const std::vector<unsigned int> &free);

  bool is_positive_definite() const; ///< to round-off; nothing else may be asked unless it is

  /** `S_FF^-1 x_F`, and zero elsewhere. */
  dealii::Vector<double> solve(const dealii::Vector<double> &x) const;

private:
  std::vector<unsigned int> free;
  std::vector<double> factor; ///< lower triangle by columns
  bool positive_definite;
};
} // namespace hpvi

#endif
