// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_plate_reader_h
#define hpvi_plate_reader_h

#include <hpvi/reader/input/expressions.h>
#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/**
 * Takes what @p section says of a rigid plate, Displacement among it, which is of no node then. Values are those at the
 * first of @p points, wherever that is. Without Rigid its entries must be empty.
 */
template <int dim>
void read_plate(const Parameters &parameters, const ExpressionReader<dim> &expressions,
                const std::string &section, const std::vector<dealii::Point<dim>> &points,
                double thickness, bool is_axisymmetric, BoundaryCondition<dim> &boundary);
} // namespace hpvi

#endif
