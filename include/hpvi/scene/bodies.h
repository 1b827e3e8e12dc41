// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_bodies_h
#define hpvi_bodies_h

#include <hpvi/scene/geometry.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <string>
#include <vector>

namespace hpvi
{
/** A body by itself, before its sides have its name. */
template <int dim>
struct SingleBody
{
  std::string name;
  Geometry<dim> geometry;
};

/** The cells of a regular grid one by one; a mesh as it is. */
CoarseMesh cells_of(const Geometry<2> &geometry);
HexahedralMesh cells_of(const Geometry<3> &geometry);

/**
 * Several bodies as one geometry: cells and vertices one body after the other, nothing shared; the side `top` of the body
 * `punch` is the boundary `punch.top`, and each body has surfaces of its own.
 */
Geometry<2> geometry_of_bodies(const std::vector<SingleBody<2>> &bodies);
Geometry<3> geometry_of_bodies(const std::vector<SingleBody<3>> &bodies);
} // namespace hpvi

#endif
