// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/results/warnings/line.h>
#include <hpvi/results/warnings/warnings.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
Warnings elongated_elements(const BodyState<dim> &body)
{
  if (body.elongation < 20 * (1 - 1e-12))
    return {};
  return {{WarningKind::elongation, body.elongation,
           line("elements up to ", body.elongation, " times as long as wide, at (", body.elongated,
                "): constants of the error indicator grow with that, and where loads jump, or "
                "shear at a corner, so does the bound of the error; take more cells along the "
                "body, Geometry/Subdivisions")}};
}

/**
 * A parallelogram of 5 degrees multiplies the indicator by 50 and round-off by 1000, which grows
 * like the inverse square of the angle; near 180 degrees alone much less happens.
 */
Warnings sharp_corners(const Geometry<2> &geometry)
{
  std::string list;
  for (const Corner &corner : corners_of(geometry))
    if (corner.degrees < 5 || (corner.degrees > 175 && !geometry.has_mesh()))
      list +=
          line(list.empty() ? "" : ", ", text(corner.degrees, 4), " degrees at (", corner.at, ")");
  if (list.empty())
    return {};
  return {{WarningKind::corners, 0.,
           "the body has corners of " + list +
               ": distorted elements enlarge the error indicator and round-off; cut the body in "
               "another way or compare with a finer mesh"}};
}

/** Where two edges of a cell are almost one line or one smooth curve. */
Warnings flat_corners(const Geometry<2> &geometry)
{
  if (!geometry.mesh)
    return {};
  const CellFlaw worst = worst_cell(*geometry.mesh);
  if (worst.angle <= 170)
    return {};
  return {
      {WarningKind::corners, worst.angle,
       line("a cell has a corner of ", text(worst.angle, 5), " degrees at (", worst.at,
            "): accuracy suffers there; let the mesh have another vertex nearby, so that no cell "
            "has two edges on one smooth line")}};
}

Warnings flat_corners(const Geometry<3> &)
{
  return {};
}

/** Boxes. */
Warnings sharp_corners(const Geometry<3> &)
{
  return {};
}

/** Displacements are those since the body was at rest, so that past load steps count. */
template <int dim>
Warnings large_strain(const BodyState<dim> &body)
{
  const auto &worst = *std::max_element(body.gradients.begin(), body.gradients.end(),
                                        [](const auto &a, const auto &b)
                                        { return a.largest_strain() < b.largest_strain(); });
  if (worst.largest_strain() < 0.05)
    return {};
  return {{WarningKind::strain, worst.largest_strain(),
           line("the strain is ", 100 * worst.largest_strain(),
                " % on average over the coarse cell at (", worst.centre,
                "): linear elasticity is for strains of a few percent at most; check loads, "
                "prescribed displacements and Young's modulus")}};
}

/** A body that turns by the angle a grows by `1/cos a - 1` in linear theory, 0.4 % at 5 degrees. */
template <int dim>
Warnings large_rotation(const BodyState<dim> &body)
{
  const auto &worst =
      *std::max_element(body.gradients.begin(), body.gradients.end(),
                        [](const auto &a, const auto &b) { return a.rotation() < b.rotation(); });
  const double degrees = worst.rotation() * 180 / numbers::PI;
  if (degrees < 5)
    return {};
  return {{WarningKind::rotation, degrees,
           line("the body turns by ", degrees, " degrees on average over the coarse cell at (",
                worst.centre,
                "): linear elasticity is for rotations of a few degrees at most; check loads, "
                "prescribed displacements and Young's modulus")}};
}

/** With lambda/mu large, low degrees lock: doc/stability.md shows by how much. */
template <int dim>
Warnings locking(const Scene<dim> &scene, const BodyState<dim> &body)
{
  unsigned int lowest = 4; // locks no more
  const Material *locked = nullptr;
  for (unsigned int m = 0; m < scene.materials.size(); ++m)
  {
    unsigned int degree = body.degrees[m];
    // hp meshes that began with low degrees are refined for what those could not resolve.
    if (scene.adaptivity.method >= Method::hpa1)
      degree = std::min(degree, scene.adaptivity.start_degree);
    if (degree < lowest && scene.materials[m].locking_ratio(dim) >= 50)
    {
      lowest = degree;
      locked = &scene.materials[m];
    }
  }
  if (locked == nullptr)
    return {};
  return {{WarningKind::locking, locked->locking_ratio(dim),
           line(locked->locking_in_words(dim), " and elements of degree ", lowest,
                " may lock; use Start degree = 6")}};
}
} // namespace

template <int dim>
Warnings mesh_warnings(const Scene<dim> &scene, const BodyState<dim> &body)
{
  return joined(elongated_elements(body), sharp_corners(scene.geometry),
                flat_corners(scene.geometry), large_strain(body), large_rotation(body),
                locking(scene, body));
}

template Warnings mesh_warnings(const Scene<2> &, const BodyState<2> &);
template Warnings mesh_warnings(const Scene<3> &, const BodyState<3> &);
} // namespace hpvi
