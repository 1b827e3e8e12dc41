// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/geometry.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace hpvi
{
using namespace dealii;

std::vector<std::string> boundary_names(const int dim)
{
  std::vector<std::string> names = {"left", "right", "bottom", "top", "front", "back"};
  names.resize(2 * dim);
  return names;
}

template <int dim>
Corners<dim> box_corners(const Point<dim> &lower, const Point<dim> &upper)
{
  Corners<dim> corners;
  for (unsigned int v = 0; v < corners.size(); ++v)
    for (unsigned int d = 0; d < dim; ++d)
      corners[v][d] = ((v >> d) & 1u) ? upper[d] : lower[d];
  return corners;
}

Corners<2> quadrilateral_corners(const std::array<Point<2>, 4> &around)
{
  return {{around[0], around[1], around[3], around[2]}};
}

template <int dim>
Geometry<dim>::Geometry()
{
  Point<dim> upper;
  for (unsigned int d = 0; d < dim; ++d)
    upper[d] = 1.;
  corners = box_corners(Point<dim>(), upper);
  subdivisions.fill(1);
}

template <int dim>
Point<dim> Geometry<dim>::point(const Point<dim> &unit) const
{
  // One direction after the other, from the nearer end: a side along an axis stays there to the last bit.
  Corners<dim> between = corners;
  for (unsigned int d = dim, n = corners.size(); d-- > 0;)
  {
    n /= 2;
    for (unsigned int v = 0; v < n; ++v)
      if (const Tensor<1, dim> across = between[v + n] - between[v]; unit[d] < 0.5)
        between[v] += unit[d] * across;
      else
        between[v] = between[v + n] - (1. - unit[d]) * across;
  }
  return between[0];
}

template <int dim>
std::vector<double> Geometry<dim>::grid_lines(const unsigned int direction) const
{
  std::vector<double> lines(subdivisions[direction] + 1);
  for (unsigned int i = 0; i < lines.size(); ++i)
    lines[i] = double(i) / subdivisions[direction];
  lines.insert(lines.end(), cuts[direction].begin(), cuts[direction].end());
  std::sort(lines.begin(), lines.end());
  return lines;
}

template <int dim>
unsigned int Geometry<dim>::n_cells(const unsigned int direction) const
{
  return subdivisions[direction] + cuts[direction].size();
}

template <int dim>
bool Geometry<dim>::has_affine_cells() const
{
  double size = 0, skew = 0, coordinates = 0; // far from the origin these are rounded more coarsely
  for (unsigned int v = 0; v < corners.size(); ++v)
  {
    Tensor<1, dim> affine; // from corner 0
    for (unsigned int d = 0; d < dim; ++d)
      if (v >> d & 1u)
        affine += corners[1u << d] - corners[0];
    size = std::max(size, affine.norm());
    skew = std::max(skew, (corners[v] - corners[0] - affine).norm());
    coordinates += corners[v].norm();
  }
  return skew <= 1e-12 * size + 2 * std::numeric_limits<double>::epsilon() * coordinates;
}

template <int dim>
double Geometry<dim>::diameter() const
{
  double result = 0;
  for (unsigned int v = 0; v < corners.size(); ++v)
    for (unsigned int w = 0; w < v; ++w)
      result = std::max(result, corners[w].distance(corners[v]));
  return result;
}

template <int dim>
double Geometry<dim>::radius() const
{
  const Point<dim> middle = centre();
  double result = 0;
  for (const Point<dim> &corner : corners)
    result = std::max(result, corner.distance(middle));
  return result;
}

template <int dim>
Point<dim> Geometry<dim>::centre() const
{
  Point<dim> result;
  for (const Point<dim> &corner : corners)
    result += corner / double(corners.size());
  return result;
}

template <int dim>
bool Geometry<dim>::contains(const Point<dim> &x) const
{
  const std::vector<Side<dim>> sides = sides_of(*this);
  return std::all_of(sides.begin(), sides.end(),
                     [&](const Side<dim> &side)
                     { return side.normal(x) * (x - side.ends[0]) <= 2e-10 * radius(); });
}

std::array<Corner, 4> corners_of(const Geometry<2> &geometry)
{
  std::array<Corner, 4> result;
  for (unsigned int c = 0; c < result.size(); ++c)
  {
    // Neighbours differ in one bit of the lexicographic number.
    const Tensor<1, 2> a = geometry.corners[c ^ 1u] - geometry.corners[c],
                       b = geometry.corners[c ^ 2u] - geometry.corners[c];
    result[c] = {geometry.corners[c],
                 std::atan2(std::abs(a[0] * b[1] - a[1] * b[0]), a * b) * 180. / numbers::PI};
  }
  return result;
}

namespace
{
/** The points of a regular grid in the unit cube, @p n cells in each direction, y or z fastest. */
template <int dim>
std::vector<Point<dim>> unit_grid(const unsigned int n)
{
  std::vector<Point<dim>> points(1);
  for (unsigned int d = 0; d < dim; ++d)
  {
    std::vector<Point<dim>> finer;
    for (Point<dim> point : points)
      for (unsigned int i = 0; i <= n; ++i)
      {
        point[d] = double(i) / n;
        finer.push_back(point);
      }
    points = finer;
  }
  return points;
}
} // namespace

template <int dim>
std::vector<Point<dim>> sample_body(const Geometry<dim> &geometry)
{
  std::vector<Point<dim>> points = unit_grid<dim>(16);
  for (Point<dim> &point : points)
    point = geometry.point(point);
  return points;
}

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
  for (const Piece &piece : pieces)
  {
    const auto first = sample_segment(piece[0], piece[n_corners - 2], dim == 2 ? 0 : 16),
               last = sample_segment(piece[1], piece[n_corners - 1], dim == 2 ? 0 : 16);
    for (unsigned int i = 0; i < first.size(); ++i)
      for (const Point<dim> &point : sample_segment(first[i], last[i], dim == 2 ? 32 : 16))
        points.push_back(point);
  }
  return points;
}

template <int dim>
Tensor<1, dim> Side<dim>::normal(const Point<dim> &) const
{
  return outward; // of a flat side everywhere
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

template <int dim>
std::vector<Side<dim>> sides_of(const Geometry<dim> &geometry)
{
  const Point<dim> centre = geometry.centre();
  std::vector<Side<dim>> sides(GeometryInfo<dim>::faces_per_cell);
  for (unsigned int f = 0; f < sides.size(); ++f)
  {
    Side<dim> &side = sides[f];
    side.axis = GeometryInfo<dim>::unit_normal_direction[f];
    for (unsigned int v = 0; v < side.n_corners; ++v)
      side.ends[v] = geometry.corners[GeometryInfo<dim>::face_to_cell_vertices(f, v)];
    side.pieces = {side.ends};
    const Tensor<1, dim> along = side.ends[1] - side.ends[0];
    if constexpr (dim == 2)
      side.outward = cross_product_2d(along) / along.norm();
    else
    {
      const Tensor<1, dim> across = side.ends[2] - side.ends[0];
      side.outward = cross_product_3d(along / along.norm(), across / across.norm());
      side.outward /= side.outward.norm();
    }
    if (side.outward * (side.ends[0] - centre) < 0)
      side.outward *= -1.;
  }
  return sides;
}

template <int dim>
std::vector<Point<dim>> common_points(const Side<dim> &one, const Side<dim> &two)
{
  std::vector<Point<dim>> result;
  for (const auto &a : one.pieces)
    for (const auto &b : two.pieces)
    {
      std::vector<Point<dim>> corners;
      for (const Point<dim> &corner : a)
        if (std::find(b.begin(), b.end(), corner) != b.end())
          corners.push_back(corner);
      if (corners.size() == 2)
        corners = sample_segment(corners[0], corners[1], 16);
      result.insert(result.end(), corners.begin(), corners.end());
    }
  return result;
}

template <int dim>
Tensor<1, dim> RigidBodyMotion<dim>::at(const Point<dim> &x) const
{
  static_assert(dim == 2, "a rotation is a number");
  const Tensor<1, dim> arm = x - centre;
  return translation + rotation * Tensor<1, dim>({-arm[1], arm[0]});
}

template <int dim>
bool RigidBodyMotion<dim>::is_translation() const
{
  return rotation == 0.;
}

template <int dim>
std::string RigidBodyMotion<dim>::direction() const
{
  std::ostringstream text;
  if (is_translation())
    text << "along (" << translation / translation.norm() << ')';
  else
    text << "about (" << centre + Tensor<1, dim>({-translation[1], translation[0]}) / rotation
         << ')';
  return text.str();
}

template <int dim>
RigidBodyMotion<dim> combined(const std::vector<RigidBodyMotion<dim>> &motions,
                              const Vector<double> &coefficients)
{
  RigidBodyMotion<dim> result{{}, 0, motions.front().centre};
  for (unsigned int j = 0; j < motions.size(); ++j)
  {
    // A rotation by round-off would be one about a far point.
    if (std::abs(coefficients[j]) < 1e-10 * coefficients.linfty_norm())
      continue;
    result.translation += coefficients[j] * motions[j].translation;
    result.rotation += coefficients[j] * motions[j].rotation;
  }
  return result;
}

template struct RigidBodyMotion<2>;
template RigidBodyMotion<2> combined(const std::vector<RigidBodyMotion<2>> &,
                                     const Vector<double> &);
template Corners<2> box_corners(const Point<2> &, const Point<2> &);
template Corners<3> box_corners(const Point<3> &, const Point<3> &);
template struct Geometry<2>;
template struct Geometry<3>;
template struct Side<2>;
template struct Side<3>;
template std::vector<Side<2>> sides_of(const Geometry<2> &);
template std::vector<Side<3>> sides_of(const Geometry<3> &);
template std::vector<Point<2>> common_points(const Side<2> &, const Side<2> &);
template std::vector<Point<3>> common_points(const Side<3> &, const Side<3> &);
template std::vector<Point<2>> sample_body(const Geometry<2> &);
template std::vector<Point<3>> sample_body(const Geometry<3> &);
} // namespace hpvi
