// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_plate_with_hole_h
#define hpvi_plate_with_hole_h

#include <hpvi/reader/shapes/shape.h>

namespace hpvi
{
/** A rectangle without the disc around a point of it, or around one of its corners a quarter of the disc. */
struct PlateWithHole
{
  dealii::Point<2> lower, upper; ///< corners
  dealii::Point<2> centre;       ///< of the hole: inside, or of a quarter a corner
  double radius;                 ///< [length]
  bool is_quarter = false;
  unsigned int radial =
      1; ///< cells from the hole to the sides, longer by one factor from layer to layer
  unsigned int angular = 1; ///< cells along an eighth of the hole

  /** Boundaries `left right bottom top hole`. */
  CoarseMesh mesh() const;
};

/** For the list of shapes(). */
ShapeKind<2> plate_with_hole_shape();
} // namespace hpvi

#endif
