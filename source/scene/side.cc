// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/box_tree.h>
#include <hpvi/scene/edge_path.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <algorithm>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** @p n + 1 equidistant points, both ends exactly, for conditions that meet there. */
template <int dim>
std::vector<Point<dim>> sample_segment(const Point<dim> &a, const Point<dim> &b,
                                       const unsigned int n)
{
  std::vector<Point<dim>> points;
  for (unsigned int i = 0; i < n; ++i)
    points.push_back(a + (double(i) / n) * (b - a));
  points.push_back(b);
  return points;
}
} // namespace

template <int dim>
std::vector<Point<dim>> Side<dim>::sample() const
{
  std::vector<Point<dim>> points;
  const unsigned int n = dim == 2 ? 32 : pieces.size() > 64 ? 2 : pieces.size() > 16 ? 4 : 16;
  for (unsigned int k = 0; k < pieces.size(); ++k)
  {
    const Piece &piece = pieces[k];
    if (const Curve own = curve(k))
    {
      if constexpr (dim == 2)
        for (unsigned int i = 0; i <= n; ++i)
          points.push_back(point(k, double(i) / n));
      else
        for (unsigned int i = 0; i < (n + 1) * (n + 1); ++i)
          points.push_back(own.point(Point<2>(double(i % (n + 1)) / n, double(i / (n + 1)) / n)));
      continue;
    }
    const auto first = sample_segment(piece[0], piece[n_corners - 2], dim == 2 ? 0 : n),
               last = sample_segment(piece[1], piece[n_corners - 1], dim == 2 ? 0 : n);
    for (unsigned int i = 0; i < first.size(); ++i)
      for (const Point<dim> &point : sample_segment(first[i], last[i], n))
        points.push_back(point);
  }
  return points;
}

template <int dim>
typename Side<dim>::Curve Side<dim>::curve(const unsigned int piece) const
{
  return curves.empty() ? Curve() : curves[piece];
}

template <int dim>
Point<dim> Side<dim>::point(const unsigned int piece, const double s) const
{
  if constexpr (dim == 2)
    if (!curves.empty() && curves[piece] && s > 0 && s < 1)
      return curves[piece].point(s);
  return s < 1 ? pieces[piece][0] + s * (pieces[piece][1] - pieces[piece][0]) : pieces[piece][1];
}

template <int dim>
Tensor<1, dim> Side<dim>::normal(const unsigned int piece, const double s) const
{
  Tensor<1, dim> result = outward;
  if constexpr (dim == 2)
    if (result.norm_square() == 0)
    {
      result =
          cross_product_2d(!curves.empty() && curves[piece] ? curves[piece].derivative(s)
                                                            : pieces[piece][1] - pieces[piece][0]);
      result /= result.norm();
    }
  return result;
}

namespace
{
EdgePath path_of(const Side<2> &side, const unsigned int piece)
{
  return {side.pieces[piece], side.curve(piece)};
}
} // namespace

template <int dim>
Tensor<1, dim> Side<dim>::normal(const unsigned int piece, const Point<dim> &x) const
{
  if (is_flat())
    return outward;
  if constexpr (dim == 2)
    return normal(piece, path_of(*this, piece).nearest(x));
  else if (const CurvedFace own = curve(piece))
    return own.normal(own.nearest(x));
  else
    return normal_of(pieces[piece]);
}

template <int dim>
double Side<dim>::distance(const unsigned int piece, const Point<dim> &x) const
{
  if constexpr (dim == 2)
    return point(piece, path_of(*this, piece).nearest(x)).distance(x);
  else if (const CurvedFace own = curve(piece))
    return own.distance(x);
  else
    return hpvi::distance(pieces[piece], x);
}

template <int dim>
BoundingBox<dim> Side<dim>::box(const unsigned int piece) const
{
  if constexpr (dim == 2)
    return box_around(path_of(*this, piece));
  else if (const CurvedFace own = curve(piece))
    return own.box();
  else
  {
    BoundingBox<3> result(std::vector<Point<3>>(pieces[piece].begin(), pieces[piece].end()));
    result.extend(0.01 * pieces[piece][0].distance(pieces[piece][3]));
    return result;
  }
}

template <int dim>
bool Side<dim>::is_flat() const
{
  return outward.norm_square() > 0;
}

/** Of pieces with normals of their own that of the nearest one; at their ends that of the first. */
template <int dim>
Tensor<1, dim> Side<dim>::normal(const Point<dim> &x) const
{
  if (is_flat())
    return outward;
  unsigned int nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (unsigned int k = 0; k < pieces.size(); ++k)
    if (dim == 2 &&
        centre_of<dim>(pieces[k]).distance(x) - pieces[k][0].distance(pieces[k][1]) > least)
      continue; // farther whatever its curve does, and curves take long to ask
    else if (const double here = distance(k, x); here < (dim == 2 ? (1 - 1e-9) * least : least))
    {
      least = here;
      nearest = k;
    }
  return normal(nearest, x);
}

template <int dim>
Tensor<1, dim> Side<dim>::tangent(const Point<dim> &x) const
{
  Tensor<1, dim> result;
  if constexpr (dim == 2)
    result = -cross_product_2d(normal(x));
  else
    Assert(false, ExcMessage("A side in space has two tangents."));
  return result;
}

namespace
{
/** Edge by edge. */
std::vector<Side<2>> sides_of_mesh(const CoarseMesh &mesh)
{
  std::vector<Side<2>> sides(mesh.boundaries.size());
  for (const CoarseMesh::Edge &edge : mesh.edges)
    if (edge.boundary != CoarseMesh::inside)
    {
      Side<2> &side = sides[edge.boundary];
      side.pieces.push_back({{mesh.vertices[edge.vertices[0]], mesh.vertices[edge.vertices[1]]}});
      side.curves.push_back(edge.curve);
    }
  return sides;
}
} // namespace

template <int dim>
std::vector<Side<dim>> sides_of(const Geometry<dim> &geometry)
{
  if constexpr (dim == 2)
    if (geometry.mesh)
      return sides_of_mesh(*geometry.mesh);
  if constexpr (dim == 3)
    if (geometry.mesh)
      return sides_of_mesh(*hexahedra_of(geometry));
  const Point<dim> centre = geometry.centre();
  std::vector<Side<dim>> sides(GeometryInfo<dim>::faces_per_cell);
  for (unsigned int f = 0; f < sides.size(); ++f)
  {
    Side<dim> &side = sides[f];
    side.axis = GeometryInfo<dim>::unit_normal_direction[f];
    typename Side<dim>::Piece ends;
    for (unsigned int v = 0; v < side.n_corners; ++v)
      ends[v] = geometry.corners[GeometryInfo<dim>::face_to_cell_vertices(f, v)];
    side.pieces = {ends};
    const Tensor<1, dim> along = ends[1] - ends[0];
    if constexpr (dim == 2)
      side.outward = cross_product_2d(along) / along.norm();
    else
    {
      const Tensor<1, dim> across = ends[2] - ends[0];
      side.outward = cross_product_3d(along / along.norm(), across / across.norm());
      side.outward /= side.outward.norm();
    }
    if (side.outward * (ends[0] - centre) < 0)
      side.outward *= -1.;
  }
  return sides;
}

namespace
{
/** Of the edge of a piece in space between two of its corners. */
std::vector<Point<3>> sample_edge(const Side<3> &side, const unsigned int piece,
                                  const std::array<unsigned int, 2> &corners)
{
  std::vector<Point<3>> result =
      sample_segment(side.pieces[piece][corners[0]], side.pieces[piece][corners[1]], 16);
  if (const CurvedFace curve = side.curve(piece))
    for (unsigned int i = 1; i + 1 < result.size(); ++i)
    {
      const std::array<Point<2>, 2> ends{
          {Point<2>(corners[0] % 2, corners[0] / 2), Point<2>(corners[1] % 2, corners[1] / 2)}};
      result[i] = curve.point(ends[0] + i / 16. * (ends[1] - ends[0]));
    }
  return result;
}
} // namespace

template <int dim>
std::vector<Point<dim>> common_points(const Side<dim> &one, const Side<dim> &two)
{
  std::vector<Point<dim>> result;
  for (unsigned int k = 0; k < one.pieces.size(); ++k)
    for (const auto &b : two.pieces)
    {
      std::vector<unsigned int> corners;
      for (unsigned int v = 0; v < one.n_corners; ++v)
        if (std::find(b.begin(), b.end(), one.pieces[k][v]) != b.end())
          corners.push_back(v);
      std::vector<Point<dim>> points;
      for (const unsigned int v : corners)
        points.push_back(one.pieces[k][v]);
      if constexpr (dim == 3)
        if (corners.size() == 2)
          points = sample_edge(one, k, {{corners[0], corners[1]}});
      result.insert(result.end(), points.begin(), points.end());
    }
  return result;
}

template struct Side<2>;
template struct Side<3>;
template std::vector<Side<2>> sides_of(const Geometry<2> &);
template std::vector<Side<3>> sides_of(const Geometry<3> &);
template std::vector<Point<2>> common_points(const Side<2> &, const Side<2> &);
template std::vector<Point<3>> common_points(const Side<3> &, const Side<3> &);
} // namespace hpvi
