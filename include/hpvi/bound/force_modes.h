// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_force_modes_h
#define hpvi_force_modes_h

#include <hpvi/bound/legendre.h>
#include <hpvi/bound/modes.h>
#include <hpvi/plane/solution.h>

namespace hpvi
{
/**
 * -F in the frame B of a parallelogram with an element of degree m and size h, `-h B^-1 F`: interpolated at the points of the
 * loads, so that psi F has the moments with rigid motions that the discrete equations have.
 */
Modes<2> force_modes(const Solution<2> &solution,
                     const dealii::DoFHandler<2>::active_cell_iterator &cell,
                     const dealii::Tensor<2, 2> &B, double h, unsigned int m,
                     const LegendreTables &legendre);

/** |F - Pi F| on the cell, Pi F what the element has of @p modes. */
double missed_force(const Solution<2> &solution,
                    const dealii::DoFHandler<2>::active_cell_iterator &cell,
                    const dealii::Tensor<2, 2> &B, double h, unsigned int m, const Modes<2> &modes);
} // namespace hpvi

#endif
