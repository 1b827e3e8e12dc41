// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_bodies_h
#define hpvi_bodies_h

#include <hpvi/scene/geometry.h>

#include <string>
#include <vector>

namespace hpvi
{
/** A body by itself, before its sides have its name. */
struct SingleBody
{
  std::string name;
  Geometry<2> geometry;
};

/** The cells of a regular grid one by one; a mesh as it is. */
CoarseMesh cells_of(const Geometry<2> &geometry);

/**
 * Several bodies as one geometry: cells and vertices one body after the other, nothing shared; the side `top` of the body
 * `punch` is the boundary `punch.top`, and each body has surfaces of its own.
 */
Geometry<2> geometry_of_bodies(const std::vector<SingleBody> &bodies);
} // namespace hpvi

#endif
