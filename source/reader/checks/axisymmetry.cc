// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>
#include <hpvi/scene/boundary_parts.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The body stays on its side of the axis; where it reaches that, the side says nothing else. */
template <int dim>
void check_axis(const Scene<dim> &scene)
{
  for (const Point<dim> &corner : scene.geometry.corners)
    if (corner[0] < 0)
      reject(scene, "Material", "Plane",
             "makes x the radius, and the body has the corner " + to_string(corner) +
                 " at x < 0; move it to x >= 0",
             "axisymmetric");
  const std::vector<Side<dim>> sides = sides_of(scene);
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    // Edges of a mesh in no group are free, on the axis as well: there u_x = 0 by itself, for all else has infinite energy.
    if (boundary.name.empty() || !lies_on_axis(sides[boundary.id]))
      continue;
    if (!boundary.symmetry || boundary.has_displacement() || boundary.has_contact() ||
        boundary.has_traction() || boundary.spring || boundary.plate)
      reject(scene, section_of(boundary), "Symmetry",
             "belongs to the axis x = 0, where u_x = 0 and nothing else can act; set symmetry "
             "alone",
             boundary.symmetry ? "true" : "false");
  }
}

/** A plate around the axis moves along it alone. */
template <int dim>
void check_plates(const Scene<dim> &scene)
{
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    for (unsigned int m = 0; boundary.plate && m <= dim; ++m)
      if (m != 1 && boundary.plate->displacement[m].value_or(1.) != 0)
        reject(scene, section_of(boundary), m == 0 ? "Displacement" : "Rotation",
               "moves a rigid plate off the axis of an axisymmetric body; prescribe u_y or a force "
               "in y alone");
}
} // namespace

template <int dim>
void check_axisymmetry(const Scene<dim> &scene)
{
  const auto is_one = [](const Material &material)
  { return material.plane == PlaneModel::axisymmetric; };
  if (std::none_of(scene.materials.begin(), scene.materials.end(), is_one))
    return;
  const std::string value = "axisymmetric";
  for (const Material &material : scene.materials)
    if (dim == 3 || !is_one(material))
      reject(scene, section_of_material(material.name), "Plane",
             "belongs to the whole body in the plane; give all materials one", value);
    else if (material.orthotropy)
      reject(scene, section_of_material(material.name), "Elasticity",
             "is not offered with Plane = axisymmetric; give an isotropic material", "orthotropic");
  check_axis(scene);
  check_plates(scene);
  if (scene.thickness != 1)
    reject(scene, "Material", "Thickness",
           "is that of a plane body, and this one is axisymmetric, with forces of the full turn; "
           "remove it",
           text(scene.thickness));
  if (scene.exact_solution)
    reject(scene, "Exact solution", "Solution",
           "is that of a plane body; remove it or Plane = axisymmetric");
  if (scene.solver.normal_contact == NormalContact::nodes && scene.has_unilateral_contact())
    reject(scene, "Solver", "Normal contact",
           "is not offered with Plane = axisymmetric, for nodes on the axis have no weight; set "
           "multiplier, or automatic",
           "nodes");
}

template void check_axisymmetry(const Scene<2> &);
template void check_axisymmetry(const Scene<3> &);
} // namespace hpvi
