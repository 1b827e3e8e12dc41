// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/results/graded_boxes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Lengths of the sides of @p box in space, measured in its middle. */
template <int dim>
std::array<double, dim> lengths(const CellMap<dim> &map, const BoundingBox<dim> &box)
{
  const auto jacobian = map.jacobian(box.center());
  std::array<double, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
  {
    double square = 0;
    for (unsigned int c = 0; c < dim; ++c)
      square += jacobian[c][d] * jacobian[c][d];
    result[d] = box.side_length(d) * std::sqrt(square);
  }
  return result;
}

template <int dim>
BoundingBox<dim> half(const BoundingBox<dim> &box, const unsigned int d, const bool is_upper)
{
  auto corners = box.get_boundary_points();
  (is_upper ? corners.first : corners.second)[d] = box.center()[d];
  return BoundingBox<dim>(corners);
}

template <int dim>
void add_parts(const CellMap<dim> &map, const BoundingBox<dim> &box,
               const std::vector<Point<dim>> &singularities, const unsigned int levels,
               std::vector<BoundingBox<dim>> &boxes)
{
  const Point<dim> middle = map.point(box.center());
  const std::array<double, dim> sides = lengths(map, box);
  const double diameter =
      std::sqrt(std::inner_product(sides.begin(), sides.end(), sides.begin(), 0.));
  const bool near =
      std::any_of(singularities.begin(), singularities.end(),
                  [&](const Point<dim> &x) { return x.distance(middle) < 1.2 * diameter; });
  if (!near || levels == 0)
  {
    boxes.push_back(box);
    return;
  }
  std::vector<BoundingBox<dim>> parts{box};
  for (unsigned int d = 0; d < dim; ++d)
    if (sides[d] > *std::max_element(sides.begin(), sides.end()) / 4)
    {
      const std::vector<BoundingBox<dim>> lower = std::exchange(parts, {});
      for (const bool is_upper : {false, true})
        for (const BoundingBox<dim> &part : lower)
          parts.push_back(half(part, d, is_upper));
    }
  for (const BoundingBox<dim> &part : parts)
    add_parts(map, part, singularities, levels - 1, boxes);
}
} // namespace

template <int dim>
std::vector<BoundingBox<dim>> graded_boxes(const CellMap<dim> &map,
                                           const std::vector<Point<dim>> &singularities,
                                           const unsigned int levels)
{
  std::vector<BoundingBox<dim>> result;
  add_parts(map, create_unit_bounding_box<dim>(), singularities, levels, result);
  return result;
}

template std::vector<BoundingBox<1>> graded_boxes(const CellMap<1> &, const std::vector<Point<1>> &,
                                                  unsigned int);
template std::vector<BoundingBox<2>> graded_boxes(const CellMap<2> &, const std::vector<Point<2>> &,
                                                  unsigned int);
template std::vector<BoundingBox<3>> graded_boxes(const CellMap<3> &, const std::vector<Point<3>> &,
                                                  unsigned int);
} // namespace hpvi
