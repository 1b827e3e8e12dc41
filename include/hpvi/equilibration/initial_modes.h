// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_initial_modes_h
#define hpvi_initial_modes_h

#include <hpvi/discretisation/solution.h>
#include <hpvi/stresses/legendre.h>
#include <hpvi/stresses/modes.h>

namespace hpvi
{
/**
 * Modes of `B^-1 C eps_0 B^-T` in a parallelogram, of degrees below @p n_whole; room for @p n. They are those of the polynomial
 * through the values at the points of the discrete equations, which is what these know; what of it is left out is orthogonal to
 * the strains of hat functions times rigid motions.
 */
Modes<3> initial_modes(const Solution<2> &solution,
                       const dealii::DoFHandler<2>::active_cell_iterator &cell,
                       const dealii::Tensor<2, 2> &B, unsigned int n_whole, unsigned int n,
                       const LegendreTables &legendre);

/** The norm in complementary energy of what @p modes lack of that polynomial on the cell. */
double missed_initial_modes(const Solution<2> &solution,
                            const dealii::DoFHandler<2>::active_cell_iterator &cell,
                            const dealii::Tensor<2, 2> &B, unsigned int n_whole,
                            const Modes<3> &modes);
} // namespace hpvi

#endif
