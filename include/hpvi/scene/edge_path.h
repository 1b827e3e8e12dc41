// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_edge_path_h
#define hpvi_edge_path_h

#include <hpvi/scene/curve.h>

#include <array>
#include <optional>

namespace hpvi
{
/** What an edge of the drawing follows, counterclockwise around its body, by s in [0,1]: a curve, or the line between its ends. */
struct EdgePath
{
  std::array<dealii::Point<2>, 2> ends;
  CurvePiece curve = {}; ///< none: straight

  dealii::Point<2> point(double s) const;
  dealii::Tensor<1, 2> derivative(double s) const; ///< by s
  dealii::Tensor<1, 2> normal(double s) const;     ///< the outer unit normal
  double nearest(const dealii::Point<2> &x) const; ///< s of the point that is nearest to @p x

  EdgePath reversed() const;
};

/** What a normal meets: the place s of an edge, and how far away along the normal, negative behind it [length]. */
struct PlaceOpposite
{
  double s, distance;
};

/**
 * Where the line through @p x along the unit vector @p n meets @p path, up to round-off at its ends, and the path's own normal is
 * turned against n by 60 degrees at most: the nearest such place to x.
 */
std::optional<PlaceOpposite> place_opposite(const EdgePath &path, const dealii::Point<2> &x,
                                            const dealii::Tensor<1, 2> &n);

/** The same from a place near to it, in less time. */
std::optional<PlaceOpposite> place_opposite(const EdgePath &path, const dealii::Point<2> &x,
                                            const dealii::Tensor<1, 2> &n, double near);
} // namespace hpvi

#endif
