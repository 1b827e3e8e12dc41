// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_negligible_solution_h
#define hpvi_negligible_solution_h

#include <hpvi/discretisation/discretisation.h>

namespace hpvi
{
/**
 * What is round-off beside the data of the scene and its history is zero: multipliers @p z, then displacements @p u. True:
 * both are zero now.
 */
template <int dim>
bool drop_round_off(const Discretisation<dim> &discretisation, dealii::Vector<double> &z,
                    dealii::Vector<double> &u);
} // namespace hpvi

#endif
