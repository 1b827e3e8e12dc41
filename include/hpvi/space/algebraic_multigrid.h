// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_algebraic_multigrid_h
#define hpvi_algebraic_multigrid_h

#include <Teuchos_ParameterList.hpp>

#include <vector>

namespace hpvi
{
/**
 * What ML is told of a matrix of displacements, numbered node by node: smoothed aggregation, Chebyshev smoothers of degree
 * two, a direct solver where few unknowns are left. @p motions are the rigid motions of the unknowns of this process, one
 * after the other, and must outlive the set-up.
 */
template <int dim>
Teuchos::ParameterList algebraic_multigrid(std::vector<double> &motions);
} // namespace hpvi

#endif
