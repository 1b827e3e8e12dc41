// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_face_axes_h
#define hpvi_face_axes_h

#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/boundary_condition.h>
#include <hpvi/scene/contact_axes.h>

namespace hpvi
{
/**
 * The directions of contact at a point of a face of @p boundary. Of a curved cell in space they turn with the face: the first tangent
 * is that of a line of the reference face, which children have in common with their parent. Else contact_axes() of the normal, or of
 * `Contact direction`.
 */
template <int dim>
ContactAxes<dim> axes_of_face(const CellMap<dim> &map, unsigned int face,
                              const dealii::Point<dim> &reference,
                              const BoundaryCondition<dim> &boundary);
} // namespace hpvi

#endif
