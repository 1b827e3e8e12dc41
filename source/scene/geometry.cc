// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/geometry.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace hpvi
{
using namespace dealii;

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

std::vector<Point<2>> Edge::sample() const
{
  const unsigned int n = 32;
  std::vector<Point<2>> points;
  for (unsigned int i = 0; i < n; ++i)
    points.push_back(ends[0] + (double(i) / n) * (ends[1] - ends[0]));
  points.push_back(ends[1]); // exactly, for conditions at corners
  return points;
}

std::array<double, 4> corner_angles(const Geometry<2> &geometry)
{
  std::array<double, 4> angles;
  for (unsigned int c = 0; c < angles.size(); ++c)
  {
    // Neighbours differ in one bit of the lexicographic number.
    const Tensor<1, 2> a = geometry.corners[c ^ 1u] - geometry.corners[c],
                       b = geometry.corners[c ^ 2u] - geometry.corners[c];
    angles[c] = std::atan2(std::abs(a[0] * b[1] - a[1] * b[0]), a * b) * 180. / numbers::PI;
  }
  return angles;
}

Point<2> centre_of(const Geometry<2> &geometry)
{
  Point<2> centre;
  for (const Point<2> &corner : geometry.corners)
    centre += corner / 4.;
  return centre;
}

std::vector<Edge> edges_of(const Geometry<2> &geometry)
{
  const Point<2> centre = centre_of(geometry);
  std::vector<Edge> edges(GeometryInfo<2>::faces_per_cell);
  for (unsigned int f = 0; f < edges.size(); ++f)
  {
    Edge &edge = edges[f];
    for (unsigned int v = 0; v < 2; ++v)
    {
      edge.corners[v] = GeometryInfo<2>::face_to_cell_vertices(f, v);
      edge.ends[v] = geometry.corners[edge.corners[v]];
    }
    const Tensor<1, 2> along = edge.ends[1] - edge.ends[0];
    edge.normal[0] = along[1] / along.norm();
    edge.normal[1] = -along[0] / along.norm();
    if (edge.normal * (edge.ends[0] - centre) < 0)
      edge.normal *= -1.;
  }
  return edges;
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

std::vector<Point<2>> sample_side(const Geometry<2> &geometry, const unsigned int side)
{
  return edges_of(geometry)[side].sample();
}

std::vector<Point<3>> sample_side(const Geometry<3> &geometry, const unsigned int side)
{
  std::vector<Point<3>> points;
  for (const Point<3> &point : unit_grid<3>(16))
    if (point[side / 2] == side % 2)
      points.push_back(geometry.point(point));
  return points;
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
template std::vector<Point<2>> sample_body(const Geometry<2> &);
template std::vector<Point<3>> sample_body(const Geometry<3> &);
} // namespace hpvi
