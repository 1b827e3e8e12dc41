// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/side_normals.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
SideNormals<dim>::SideNormals(const Side<dim> &side) : side(side)
{
  if (side.is_flat())
    return;
  std::vector<BoundingBox<dim>> boxes;
  for (unsigned int piece = 0; piece < side.pieces.size(); ++piece)
    boxes.push_back(side.box(piece));
  tree.emplace(boxes);
}

template <int dim>
Tensor<1, dim> SideNormals<dim>::operator()(const Point<dim> &x) const
{
  return tree ? side.normal(tree->nearest(
                                x, [&](const unsigned int k) { return side.distance(k, x); },
                                dim == 2 ? 1e-9 : 0),
                            x)
              : side.outward;
}

template class SideNormals<2>;
template class SideNormals<3>;
} // namespace hpvi
