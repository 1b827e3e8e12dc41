// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_order_h
#define hpvi_contact_order_h

#include <hpvi/plane/contact_space.h>

#include <vector>

namespace hpvi
{
/**
 * Sorts faces one boundary after the other: of a mesh as its edges follow each other, counterclockwise around the body, from an end
 * of the boundary; of a grid by place along the tangent.
 */
template <int dim>
void sort_along_boundaries(const Geometry<dim> &geometry, std::vector<ContactFace<dim>> &faces);
} // namespace hpvi

#endif
