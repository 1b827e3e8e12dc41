// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_exact_side_h
#define hpvi_exact_side_h

#include <hpvi/scene/box_tree.h>
#include <hpvi/scene/edge_path.h>
#include <hpvi/scene/expression.h>
#include <hpvi/scene/geometry.h>

#include <optional>
#include <vector>

namespace hpvi
{
/** A side as the drawing has it, edge by edge, and what lies opposite to its points: the finite elements have polynomials for its curves. */
class ExactSide
{
public:
  /** The edges of the coarse mesh along the side number @p side, where @p where is positive in their middle; null: all. */
  ExactSide(const Geometry<2> &geometry, unsigned int side, const Expression<2> &where = nullptr);

  explicit ExactSide(const std::vector<EdgePath> &edges);

  const std::vector<EdgePath> &edges() const;

  /** Of the edge that is nearest to @p x. */
  unsigned int nearest_edge(const dealii::Point<2> &x) const;

  /** What the line through @p x along @p n meets of this side, with the number of its edge. */
  struct Place
  {
    unsigned int edge;
    PlaceOpposite place;
  };
  std::optional<Place> opposite(const dealii::Point<2> &x, const dealii::Tensor<1, 2> &n) const;

private:
  std::vector<EdgePath> paths;
  BoxTree<2> tree;
};

/**
 * From the point of @p own that is nearest to x to @p other, along the normal of own [length]. Where a normal meets nothing, the
 * distance of what is nearest.
 */
Expression<2> distance_along_normal(const ExactSide &own, const ExactSide &other);
} // namespace hpvi

#endif
