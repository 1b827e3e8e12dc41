// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_values_at_h
#define hpvi_values_at_h

#include <hpvi/results/field.h>

#include <optional>
#include <vector>

namespace hpvi
{
/** u_N and its stress on @p cell at the points of @p table, which is one of its degree. */
template <int dim>
std::vector<PointValue<dim>> values_at(const Field<dim> &field,
                                       const typename Field<dim>::Cell &cell,
                                       const ShapeTable<dim> &table);

/**
 * u_N and its stress at many points on one process, by cells: what Field::at() says of each, null outside the body, in a
 * time that grows like the number of cells and that of points rather than with their product. Of the number @p body of several, if it is
 * given: at a joint each has its own.
 */
template <int dim>
std::vector<std::optional<PointValue<dim>>>
values_at(const Field<dim> &field, const std::vector<dealii::Point<dim>> &points,
          std::optional<unsigned int> body = std::nullopt);
} // namespace hpvi

#endif
