// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_quadrilateral_h
#define hpvi_quadrilateral_h

#include <hpvi/reader/shapes/shape.h>

namespace hpvi
{
/** A convex quadrilateral, for the list of shapes(). */
ShapeKind<2> quadrilateral_shape();
} // namespace hpvi

#endif
