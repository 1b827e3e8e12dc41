// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_field_difference_h
#define hpvi_field_difference_h

#include <hpvi/results/field.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/quadrature.h>

#include <vector>

namespace hpvi
{
/** Displacement and its gradient at one point. */
template <int dim>
struct FieldValues
{
  dealii::Tensor<1, dim> u;
  dealii::Tensor<2, dim> gradient; ///< d u_i / d x_j
  double hoop = 0;                 ///< u_x/x in an axisymmetric body
};

/** A polynomial on one cell of a mesh. */
template <int dim>
struct LocalField
{
  unsigned int degree;
  std::vector<double> coefficients;
  CellMap<dim> map;

  /** At the points of @p gauss in a part @p box of the reference cell. */
  std::vector<FieldValues<dim>> at(const dealii::BoundingBox<dim> &box,
                                   const dealii::Quadrature<dim> &gauss) const;
};

template <int dim>
LocalField<dim> local_field(const Field<dim> &field, const typename Field<dim>::Cell &cell);

/** Integrals of squares of the difference of a field from the true one, and of that to relate it to. */
struct DifferenceSquares
{
  double energy = 0; ///< |u - u_N|_a^2, stress length^dim
  double l2 = 0;     ///< |u - u_N|_{L2}^2, length^{2+dim}
  double norm = 0;   ///< |u|_a^2

  template <int dim>
  void add(const HookesLaw<dim> &law, const FieldValues<dim> &field, const FieldValues<dim> &truth,
           const double weight)
  {
    energy += weight * law.energy_product(truth.gradient - field.gradient, truth.hoop - field.hoop);
    l2 += weight * (truth.u - field.u).norm_square();
    norm += weight * law.energy_product(truth.gradient, truth.hoop);
  }

  DifferenceSquares &operator+=(const DifferenceSquares &other);
};

DifferenceSquares total(const DifferenceSquares &own, MPI_Comm communicator); ///< collective
} // namespace hpvi

#endif
