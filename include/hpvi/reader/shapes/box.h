// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_h
#define hpvi_box_h

#include <hpvi/reader/shapes/shape.h>

namespace hpvi
{
/** A box between two corners, for the list of shapes(). */
template <int dim>
ShapeKind<dim> box_shape();
} // namespace hpvi

#endif
