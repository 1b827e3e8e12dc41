// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_edge_constraints_h
#define hpvi_edge_constraints_h

#include <deal.II/lac/affine_constraints.h>
#include <hpvi/plane/dof_numbering.h>

namespace hpvi
{
/**
 * Make the space of @p numbering continuous across edges on which degree or cell size change: on each edge the
 * displacement is a polynomial of the lowest degree that a cell on either side has there (the
 * minimum rule of (3.57)).
 *
 * deal.II's make_hanging_node_constraints gives the same space, but not such a good basis: where the
 * larger cell of a hanging edge has the higher degree, it keeps the first unknowns of that cell and
 * extrapolates the others from them, with weights that reached 5000 at p = 14. Their squares
 * multiply round-off (1e-9 of the solution was lost). Here the weights stay near 1.
 */
void constrain_hanging_nodes(const DofNumbering<2> &numbering, const ShapeTables<2> &tables,
                             dealii::AffineConstraints<double> &constraints);
} // namespace hpvi

#endif
