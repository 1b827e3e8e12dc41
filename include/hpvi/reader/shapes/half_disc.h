// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_half_disc_h
#define hpvi_half_disc_h

#include <hpvi/reader/shapes/shape.h>

namespace hpvi
{
/** Half of a disc, on one side of a diameter. */
struct HalfDisc
{
  dealii::Point<2> centre;
  double radius; ///< [length]
  double angle;  ///< of the flat side against the x axis; the disc is to the left of it [degrees]

  /**
   * Two squares at the centre and four cells around them, so that no cell has two edges on the arc. Boundaries `flat` and
   * `arc`.
   */
  CoarseMesh mesh() const;
};

/** For the list of shapes(). */
ShapeKind<2> half_disc_shape();
} // namespace hpvi

#endif
