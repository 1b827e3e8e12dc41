// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/shapes/box.h>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
std::optional<ShapeFlaw> flaw_of_box(const Corners<dim> &corners)
{
  for (unsigned int d = 0; d < dim; ++d)
    if (!(corners.front()[d] < corners.back()[d]))
      return ShapeFlaw{"Upper corner",
                       std::string(dim == 2 ? "is not above and right of" : "is not beyond") +
                           " the lower corner " + to_string(corners.front()) +
                           (dim == 2 ? "" : " in every direction") +
                           "; enlarge every coordinate beyond it",
                       to_string(corners.back())};
  if (corners != box_corners(corners.front(), corners.back()))
    return ShapeFlaw{"Shape",
                     std::string("has corners that are not those of a box; take box_corners()") +
                         (dim == 2 ? " or shape = quadrilateral" : ""),
                     "box"};
  return std::nullopt;
}
} // namespace

template <int dim>
ShapeKind<dim> box_shape()
{
  return {Shape::box,
          "box",
          "box: given by Lower corner and Upper corner.",
          {lower_corner_entry<dim>(), upper_corner_entry<dim>()},
          "Upper corner",
          [](const Parameters &parameters, Geometry<dim> &geometry)
          {
            geometry.corners = box_corners(parameters.points<dim>("Geometry", "Lower corner")[0],
                                           parameters.points<dim>("Geometry", "Upper corner")[0]);
          },
          flaw_of_box<dim>};
}

template ShapeKind<2> box_shape();
template ShapeKind<3> box_shape();
} // namespace hpvi
