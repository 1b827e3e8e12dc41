// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_side_normals_h
#define hpvi_side_normals_h

#include <hpvi/scene/box_tree.h>
#include <hpvi/scene/geometry.h>

#include <optional>

namespace hpvi
{
/** Normals of a side at many points: those of Side::normal, which looks at all pieces for each. */
template <int dim>
class SideNormals
{
public:
  explicit SideNormals(const Side<dim> &side);

  dealii::Tensor<1, dim> operator()(const dealii::Point<dim> &x) const;

private:
  const Side<dim> side;
  std::optional<BoxTree<dim>> tree; ///< of its pieces, where they have normals of their own
};
} // namespace hpvi

#endif
