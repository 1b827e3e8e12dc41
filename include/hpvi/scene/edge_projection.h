// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_edge_projection_h
#define hpvi_edge_projection_h

#include <hpvi/scene/exact_side.h>

#include <array>
#include <string>
#include <vector>

namespace hpvi
{
/** Of an edge: what hangs over the end of the other side by no more ends there, for drawings have so many digits. */
constexpr double same_end = 1e-6;

/** Of two sides, curved or at an angle to each other, the edges that make a pair. */
struct ProjectedEdges
{
  std::array<std::vector<bool>, 2> in_pair; ///< by edge of either side
  std::optional<unsigned int> slave;        ///< which has to be it; nothing: either may
  double least = 0, largest = 0;  ///< distance along the normal of the first slave [length]
  dealii::Point<2> at_least = {}; ///< where they are nearest, or deepest inside each other
  double least_for_sure = 0;      ///< of splines as far apart as their points allow
  double doubt = 0;               ///< the largest of what these leave open, of both sides
  /** Edges of that slave of which a part alone lies opposite, and too far away for anybody to press there. */
  struct
  {
    unsigned int number = 0;
    double distance = 0;      ///< the least [length]
    dealii::Point<2> at = {}; ///< the middle of that edge
  } left_out;

  bool is_empty() const;
};

/**
 * An edge of the slave has every one of its points opposite to the other side; edges of the master may hang over. One of which
 * some points are opposite and others are not is left out unless it comes nearer than 2 % of @p size, that of the smaller body, or of the radius R of
 * the relative curvature there: beside a contact of half width a the distance is a^2/2R, and small strains want a/R below 0.2. @p asked: the
 * side that shall be slave. Where both may be and lie opposite to the same edges from either side, either is. Throws nothing: where
 * there is no pair @p problem says why in words that go on after "the sides", and none is in it.
 */
ProjectedEdges edge_projection(const std::array<ExactSide, 2> &sides,
                               std::optional<unsigned int> asked, double size,
                               std::string &problem);
} // namespace hpvi

#endif
