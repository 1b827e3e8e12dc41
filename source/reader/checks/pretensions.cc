// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>
#include <hpvi/reader/pretension_reader.h>
#include <hpvi/scene/bodies.h>
#include <hpvi/scene/boundary_parts.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** What on a boundary with outer @p normal the motion along @p n would do work on; empty: nothing. */
std::string acts_along(const BoundaryCondition<2> &boundary, const Tensor<1, 2> &normal,
                       const Tensor<1, 2> &n)
{
  const auto is_across = [&](const Tensor<1, 2> &direction)
  { return std::abs(direction * n) <= same_normal; };
  if (boundary.plate)
    return "Rigid";
  if (boundary.spring)
    return "Spring";
  for (unsigned int d = 0; d < 2; ++d)
  {
    if (boundary.displacement[d] && std::abs(n[d]) > same_normal)
      return "Displacement";
    if (boundary.traction[d])
      return "a load";
  }
  if (boundary.symmetry && !is_across(normal))
    return "Symmetry";
  if (boundary.has_contact() &&
      (boundary.is_tied() || boundary.friction || !is_across(boundary.held_direction(normal))))
    return boundary.is_tied()  ? "tied contact"
           : boundary.friction ? "friction"
                               : "contact along the bolt";
  return {};
}

/** The sides of the layer move with psi n, and nothing may notice. */
void check_sides(const Scene<2> &scene, const Pretension<2> &cut)
{
  const double tolerance = same_place * scene.geometry.diameter();
  const auto depth = [&](const Point<2> &x) { return (x - cut.from) * cut.normal; };
  for (unsigned int side = 0; side < scene.geometry.boundary_names().size(); ++side)
    for (const CoarseFace<2> &face : coarse_faces(scene.geometry, side))
    {
      if (!cut.cell(face.inside) ||
          std::min(depth(face.corners[0]), depth(face.corners[1])) > cut.depth - tolerance)
        continue;
      const BoundaryCondition<2> &boundary =
          scene.boundaries[boundary_at(scene, side, middle_of(face))];
      Tensor<1, 2> normal = face.corners[1] - face.corners[0];
      normal = Tensor<1, 2>({normal[1], -normal[0]}) / normal.norm();
      if (const std::string what = acts_along(boundary, normal, cut.normal); !what.empty())
        reject(scene, section_of_pretension(cut.name), "Through",
               "has " + what + " of " + section_of(boundary) + " beside it, at " +
                   to_string(middle_of(face)) +
                   ", on its left on the way from the first point to the second; move the cut, "
                   "draw a line parallel to it where cells end, or swap its points");
    }
}
} // namespace

template <>
void check_pretensions(const Scene<2> &scene)
{
  for (const Pretension<2> &cut : scene.pretensions)
  {
    if (!cut.is_fixed && !(cut.force > 0 && std::isfinite(cut.force)))
      reject(scene, section_of_pretension(cut.name), "Force",
             "is no tension; give a positive number", std::to_string(cut.force));
    check_sides(scene, cut);
  }
}

template <>
void check_pretensions(const Scene<3> &)
{
}
} // namespace hpvi
