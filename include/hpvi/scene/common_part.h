// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_common_part_h
#define hpvi_common_part_h

#include <deal.II/base/point.h>

#include <vector>

namespace hpvi
{
/** The corners of a convex polygon in the plane, counterclockwise. */
using ConvexPolygon = std::vector<dealii::Point<2>>;

double area_of(const ConvexPolygon &polygon); ///< [length^2], negative where it runs clockwise

/** What two polygons have in common, by I. E. Sutherland and G. W. Hodgman (DOI 10.1145/360767.360802); it may be empty. */
ConvexPolygon common_part(const ConvexPolygon &one, const ConvexPolygon &other);

/** A point with its weight [length^2]. */
struct WeightedPoint
{
  dealii::Point<2> x;
  double weight;
};

/** Gauss rules with @p n points a direction on the triangles of a polygon, exact for polynomials of degree 2n - 2. */
std::vector<WeightedPoint> rule_on(const ConvexPolygon &polygon, unsigned int n);
} // namespace hpvi

#endif
