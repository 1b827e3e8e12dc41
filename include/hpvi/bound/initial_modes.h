// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_initial_modes_h
#define hpvi_initial_modes_h

#include <hpvi/bound/legendre.h>
#include <hpvi/bound/modes.h>
#include <hpvi/plane/solution.h>

namespace hpvi
{
/** An initial stress C eps_0 in a parallelogram. */
struct InitialModes
{
  Modes<3> modes;
  double missed =
      0; ///< norm in complementary energy of what they lack of the polynomial on the cell
};

/**
 * Modes of `B^-1 C eps_0 B^-T` in a parallelogram, of degrees below @p n_whole; room for @p n. They are those of the polynomials
 * through the values at the points of the discrete equations, on each part of their rule, which is what these know; what of it is left out is orthogonal to
 * the strains of hat functions times rigid motions.
 */
InitialModes initial_modes(const Solution<2> &solution,
                           const dealii::DoFHandler<2>::active_cell_iterator &cell,
                           const dealii::Tensor<2, 2> &B, unsigned int n_whole, unsigned int n);
} // namespace hpvi

#endif
