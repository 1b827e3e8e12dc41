// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_inverse_map_h
#define hpvi_inverse_map_h

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <cmath>
#include <optional>

namespace hpvi
{
/**
 * The point of the unit cell that @p map takes to @p x, up to @p hair of its longest edge, by Newton's method from the middle; null:
 * the cell has none. Of @p map: point(), jacobian(), J_ij = d x_i / d xi_j, and longest_edge().
 */
template <int dim, class Map>
std::optional<dealii::Point<dim>> inverse_of(const Map &map, const dealii::Point<dim> &x,
                                             const double hair)
{
  const double size = map.longest_edge();
  dealii::Point<dim> reference;
  for (unsigned int d = 0; d < dim; ++d)
    reference[d] = 0.5;
  if (x.distance(map.point(reference)) > 2 * size)
    return std::nullopt;
  for (unsigned int step = 0; step < 30; ++step)
  {
    const dealii::Tensor<1, dim> rest = x - map.point(reference);
    if (rest.norm() <= 1e-13 * size)
      break;
    const dealii::Tensor<2, dim> J = map.jacobian(reference);
    if (!(std::abs(determinant(J)) > 1e-12 * std::pow(size, dim)))
      return std::nullopt;
    reference += invert(J) * rest;
    if (reference.norm() > 10)
      return std::nullopt;
  }
  if (x.distance(map.point(reference)) > hair * size ||
      !dealii::GeometryInfo<dim>::is_inside_unit_cell(reference, hair))
    return std::nullopt;
  return dealii::GeometryInfo<dim>::project_to_unit_cell(reference);
}
} // namespace hpvi

#endif
