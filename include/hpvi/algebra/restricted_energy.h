// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_restricted_energy_h
#define hpvi_restricted_energy_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>
#include <hpvi/algebra/linear_solver.h>

#include <memory>
#include <vector>

namespace hpvi
{
/** `(A B; B' C)`: columns of B and C behind those of A, which stays where it is. */
struct BorderedMatrix
{
  const SymmetricMatrix &A;
  SymmetricMatrix border; ///< column j is column A.n() + j of the whole, rows likewise

  unsigned int n() const
  {
    return A.n() + border.n();
  }

  /** f(row, value) for the entries of the upper triangle in one column. */
  template <class F>
  void for_each_entry(const unsigned int column, const F &f) const
  {
    const SymmetricMatrix &part = column < A.n() ? A : border;
    const unsigned int own = column < A.n() ? column : column - A.n();
    for (int k = part.column_start[own]; k < part.column_start[own + 1]; ++k)
      f(static_cast<unsigned int>(part.row[k]), part.value[k]);
  }

  /** x'Ax of one column j and half of those before it: `x_j (2 sum_{i<j} A_ij x_i + A_jj x_j)`. */
  double energy(unsigned int column, const dealii::Vector<double> &x) const;

  double energy(const dealii::Vector<double> &x) const; ///< x'Ax
};

/**
 * The energy x'Ax of x with some entries free and all others fixed, of which few are not zero. Some of the free ones are
 * kept for programs: with values z of these it is `z'Hz - 2 h'z + constant` once the rest is where it is least.
 */
class RestrictedEnergy
{
public:
  /** @p fixed has zeros where entries are free; those of @p interface are. Throws NumericalFailure. */
  RestrictedEnergy(const BorderedMatrix &A, const std::vector<bool> &is_free,
                   const dealii::Vector<double> &fixed, std::vector<unsigned int> interface);

  /** Where an unknown stands among those kept, or numbers::invalid_unsigned_int. */
  unsigned int place(unsigned int unknown) const;

  unsigned int n_kept() const;
  dealii::FullMatrix<double> H() const;
  dealii::Vector<double> h() const;

  dealii::Vector<double> minimiser() const; ///< x
  dealii::Vector<double> minimiser(
      const dealii::Vector<double> &interface_values) const; ///< with these values of those kept

private:
  SymmetricMatrix restrict(const BorderedMatrix &A, const std::vector<unsigned int> &number,
                           dealii::Vector<double> &f) const;
  dealii::Vector<double> all(const dealii::Vector<double> &forwarded) const;

  std::vector<unsigned int> free, interface; ///< unknowns; those kept in the order of the factor
  dealii::Vector<double> fixed, y;           ///< L^-1 of what the fixed ones do to the free ones
  std::unique_ptr<const LinearSolver> solver;
};
} // namespace hpvi

#endif
