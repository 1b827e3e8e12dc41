// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/edge_path.h>
#include <hpvi/scene/hexahedral_mesh.h>
#include <hpvi/scene/side_normals.h>

namespace hpvi
{
using namespace dealii;

namespace
{
EdgePath path_of(const Side<2> &side, const unsigned int piece)
{
  return {side.pieces[piece], side.curves.empty() ? CurvePiece() : side.curves[piece]};
}

BoundingBox<2> box_of(const Side<2> &side, const unsigned int piece)
{
  return box_around(path_of(side, piece));
}

BoundingBox<3> box_of(const Side<3> &side, const unsigned int piece)
{
  const Side<3>::Piece &corners = side.pieces[piece];
  BoundingBox<3> result(std::vector<Point<3>>(corners.begin(), corners.end()));
  result.extend(0.01 * corners[0].distance(corners[3]));
  return result;
}
} // namespace

template <int dim>
SideNormals<dim>::SideNormals(const Side<dim> &side) : side(side)
{
  if (side.is_flat())
    return;
  std::vector<BoundingBox<dim>> boxes;
  for (unsigned int piece = 0; piece < side.pieces.size(); ++piece)
    boxes.push_back(box_of(side, piece));
  tree.emplace(boxes);
}

template <>
Tensor<1, 2> SideNormals<2>::operator()(const Point<2> &x) const
{
  if (!tree)
    return side.outward;
  const unsigned int piece = tree->nearest(
      x, [&](const unsigned int k) { return side.distance(k, x); }, 1e-9);
  return side.normal(piece, path_of(side, piece).nearest(x));
}

template <>
Tensor<1, 3> SideNormals<3>::operator()(const Point<3> &x) const
{
  if (!tree)
    return side.outward;
  return normal_of(side.pieces[tree->nearest(x, [&](const unsigned int k)
                                             { return distance(side.pieces[k], x); })]);
}

template class SideNormals<2>;
template class SideNormals<3>;
} // namespace hpvi
