// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cell_operator_h
#define hpvi_cell_operator_h

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <memory>
#include <vector>

namespace hpvi
{
/** Of `sigma = volume tr(eps) I + 2 shear eps` [stress]: Lame's parameters. */
struct IsotropicStiffness
{
  double volume, shear;
};

/** Of `sigma_i = sum_j C_ij eps_j` [stress], the components xx, yy, zz, xy, xz, yz, strains twice the last three. */
using GeneralStiffness = std::array<std::array<double, 6>, 6>;

/**
 * Products with the stiffness matrix `int sigma(u) : eps(v)` of nodal values in space without the matrix, cell by cell by
 * sum factorisation: deal.II's MatrixFree. It is alone in a shared library of its own, which is built for the baseline of
 * x86-64 and for processors with vectors of 4 and 8 doubles; the loader takes the widest that the machine has
 * (glibc-hwcaps). So nothing of hpvi's that depends on the compiler's vectors stands in this interface.
 */
template <typename Number>
class CellOperator
{
public:
  using Vector = dealii::LinearAlgebra::distributed::Vector<Number>;

  virtual ~CellOperator() = default;

  /** y = A x; constrained entries of y are zero, those of x are taken from what they depend on. Collective. */
  virtual void multiply(Vector &y, const Vector &x) const = 0;

  virtual void reinit(Vector &v) const = 0; ///< zero, with the neighbours that multiply() wants

  /** Those of this process and beside it that depend on others or on nothing, in the numbering of a vector's local elements. */
  virtual const std::vector<unsigned int> &constrained() const = 0;
};

/** Degrees for which there is one. */
inline bool has_cell_operator(const unsigned int degree)
{
  return degree >= 2 && degree <= 4;
}

/**
 * Of the elements of @p dof_handler, one or an hp::FECollection; @p stiffness by material id, IsotropicStiffness or GeneralStiffness, which take two and 21
 * constants of a material to each point; @p mapping of cells. @p dof_handler must outlive it. Collective. Null where a degree is
 * none of has_cell_operator().
 */
template <typename Number, class Stiffness>
std::unique_ptr<CellOperator<Number>>
make_cell_operator(const dealii::Mapping<3> &mapping, const dealii::DoFHandler<3> &dof_handler,
                   const dealii::AffineConstraints<Number> &constraints,
                   const std::vector<Stiffness> &stiffness);
} // namespace hpvi

#endif
