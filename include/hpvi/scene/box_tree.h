// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_tree_h
#define hpvi_box_tree_h

#include <hpvi/scene/edge_path.h>

#include <deal.II/base/bounding_box.h>

#include <functional>
#include <memory>
#include <vector>

namespace hpvi
{
/** A square that holds an edge, with some room. */
dealii::BoundingBox<2> box_around(const EdgePath &path);

/** Edges or faces in a tree by the boxes around them: of thousands a few are looked at. */
template <int dim>
class BoxTree
{
public:
  /** There is one at least. */
  explicit BoxTree(const std::vector<dealii::BoundingBox<dim>> &boxes);

  /**
   * The number of what is nearest to @p x by @p distance, which is asked for numbers and nowhere less than the distance of the box.
   * One takes the place of one with a smaller number where it is nearer by more than @p hair of the distance.
   */
  unsigned int nearest(const dealii::Point<dim> &x,
                       const std::function<double(unsigned int)> &distance, double hair = 0) const;

  /** Ascending numbers of the boxes that the line through @p x along @p n meets, up to round-off. */
  std::vector<unsigned int> along(const dealii::Point<dim> &x,
                                  const dealii::Tensor<1, dim> &n) const;

private:
  struct Tree;
  std::shared_ptr<const Tree> tree;
};
} // namespace hpvi

#endif
