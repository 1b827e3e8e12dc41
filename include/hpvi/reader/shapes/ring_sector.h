// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_ring_sector_h
#define hpvi_ring_sector_h

#include <hpvi/reader/shapes/shape.h>

namespace hpvi
{
/** What lies between two circles and two angles. */
struct RingSector
{
  dealii::Point<2> centre;
  double inner, outer;                  ///< radii [length]
  double from, to;                      ///< angles [degrees], counterclockwise; 360 apart: a ring
  unsigned int radial = 1, angular = 1; ///< cells in these directions

  bool is_closed() const; ///< up to round-off of angles

  /** `inner`, `outer`, and unless it is closed `start` at the first angle and `end` at the last. */
  std::vector<std::string> boundaries() const;

  /** All circles are exact, also between layers of cells, where materials may meet. */
  CoarseMesh mesh() const;
};

/** For the list of shapes(). */
ShapeKind<2> ring_sector_shape();
} // namespace hpvi

#endif
