// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mean_gradients_h
#define hpvi_mean_gradients_h

#include <hpvi/results/field.h>

#include <vector>

namespace hpvi
{
/** The mean of grad u over a cell of the coarse mesh, where the singularities of a corner weigh little. */
template <int dim>
struct MeanGradient
{
  dealii::Point<dim> centre;     ///< of the cell
  dealii::Tensor<2, dim> value;  ///< d u_i / d x_j
  double largest_strain() const; ///< the principal strain of the largest absolute value
  double rotation() const;       ///< |curl u| / 2 [radians]
};

/**
 * Of every coarse cell, by `int_K grad u = int_dK u n'` over the finest cells that it is made of, without the jump that tightens a
 * bolt. Collective.
 */
template <int dim>
std::vector<MeanGradient<dim>> mean_gradients(const Field<dim> &field);
} // namespace hpvi

#endif
