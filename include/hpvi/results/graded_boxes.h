// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_graded_boxes_h
#define hpvi_graded_boxes_h

#include <hpvi/plane/cell_map.h>

#include <deal.II/base/bounding_box.h>

#include <vector>

namespace hpvi
{
/**
 * Boxes that together are the reference cell of @p map, small near singular points, which are given in
 * space: none that has been halved fewer than @p levels times is much larger than its distance from
 * them. Sides below a quarter of the longest are not cut: of a cell of 1:1000 that would make a
 * thousand boxes a level.
 */
template <int dim>
std::vector<dealii::BoundingBox<dim>>
graded_boxes(const CellMap<dim> &map, const std::vector<dealii::Point<dim>> &singularities,
             unsigned int levels);
} // namespace hpvi

#endif
