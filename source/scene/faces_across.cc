// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/scene/faces_across.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double same_way = 0.1, ///< cosine of the angle between both faces, at least
    no_part = 1e-14;             ///< of the area of a face

std::array<double, 2> extent(const ConvexPolygon &polygon, const unsigned int d)
{
  std::array<double, 2> result{{polygon[0][d], polygon[0][d]}};
  for (const Point<2> &x : polygon)
    result = {{std::min(result[0], x[d]), std::max(result[1], x[d])}};
  return result;
}
} // namespace

Point<2> FacePlane::at(const Point<3> &x) const
{
  return {(x - origin) * axes.tangents[0], (x - origin) * axes.tangents[1]};
}

Point<3> FacePlane::point(const Point<2> &x) const
{
  return origin + x[0] * axes.tangents[0] + x[1] * axes.tangents[1];
}

ConvexPolygon FacePlane::polygon(const Side<3>::Piece &face) const
{
  ConvexPolygon result;
  for (const unsigned int v : {0, 1, 3, 2})
    result.push_back(at(face[v]));
  if (area_of(result) < 0)
    std::reverse(result.begin(), result.end());
  return result;
}

FacesAcross::FacesAcross(const std::vector<Side<3>::Piece> &faces, const ContactAxes<3> &axes)
    : plane{Point<3>(), axes}, polygons(faces.size())
{
  double size = 0;
  for (unsigned int f = 0; f < faces.size(); ++f)
  {
    if (normal_of(faces[f]) * axes.normal > -same_way)
      continue; // it looks away, or is seen from its edge
    polygons[f] = plane.polygon(faces[f]);
    for (unsigned int d = 0; d < 2; ++d)
      size = std::max(size, extent(polygons[f], d)[1] - extent(polygons[f], d)[0]);
  }
  width = size > 0 ? size : 1;
  for (unsigned int f = 0; f < faces.size(); ++f)
    if (is_seen(f))
      for_squares(polygons[f],
                  [&](const std::array<long, 2> &square) { by_square[square].push_back(f); });
}

FacePlane FacesAcross::plane_of(const Side<3>::Piece &face) const
{
  return {face[0], plane.axes};
}

// Far from the origin coordinates are rounded more coarsely: what is cut has the first corner of the face for origin.
std::vector<FacesAcross::Part>
FacesAcross::opposite(const Side<3>::Piece &face,
                      const std::function<bool(unsigned int)> &counts) const
{
  const ConvexPolygon seen = plane.polygon(face), own = plane_of(face).polygon(face);
  const Tensor<1, 2> shift = plane.at(face[0]) - Point<2>();
  const double least = no_part * area_of(own);
  std::vector<Part> result;
  for (const unsigned int f : beside(seen))
  {
    if (!counts(f))
      continue;
    ConvexPolygon other = polygons[f];
    for (Point<2> &x : other)
      x -= shift;
    ConvexPolygon part = common_part(own, other);
    if (!part.empty() && area_of(part) > least)
      result.push_back({f, std::move(part)});
  }
  return result;
}

/** Numbers, ascending, of those that may lie opposite to a face. */
std::set<unsigned int> FacesAcross::beside(const ConvexPolygon &polygon) const
{
  std::set<unsigned int> result;
  for_squares(polygon,
              [&](const std::array<long, 2> &square)
              {
                if (const auto found = by_square.find(square); found != by_square.end())
                  result.insert(found->second.begin(), found->second.end());
              });
  return result;
}

template <class Take>
void FacesAcross::for_squares(const ConvexPolygon &polygon, const Take &take) const
{
  std::array<std::array<long, 2>, 2> range;
  for (unsigned int d = 0; d < 2; ++d)
    for (unsigned int end = 0; end < 2; ++end)
      range[d][end] = static_cast<long>(std::floor(extent(polygon, d)[end] / width));
  for (long i = range[0][0]; i <= range[0][1]; ++i)
    for (long j = range[1][0]; j <= range[1][1]; ++j)
      take({{i, j}});
}

FacesFromAll::FacesFromAll(std::vector<Side<3>::Piece> faces) : faces(std::move(faces))
{
}

const FacesAcross &FacesFromAll::across(const ContactAxes<3> &axes) const
{
  for (const auto &view : known)
    if ((view->normal() - axes.normal).norm() < same_direction)
      return *view;
  known.push_back(std::make_unique<const FacesAcross>(faces, axes));
  return *known.back();
}

bool SidesFacing::any() const
{
  return std::any_of(faces.begin(), faces.end(),
                     [](const Face &face) { return face.covered > uncovered_share; });
}

bool SidesFacing::are_covered() const
{
  return std::all_of(faces.begin(), faces.end(),
                     [](const Face &face) {
                       return face.covered <= uncovered_share ||
                              std::abs(face.covered - 1) <= uncovered_share;
                     });
}

SidesFacing facing_faces(const std::vector<Side<3>::Piece> &own,
                         const std::vector<Side<3>::Piece> &other, const double hair)
{
  const FacesFromAll others(other);
  SidesFacing result;
  result.least = std::numeric_limits<double>::max();
  result.largest = std::numeric_limits<double>::lowest();
  for (const Side<3>::Piece &face : own)
  {
    result.faces.emplace_back();
    SidesFacing::Face &facing = result.faces.back();
    const Tensor<1, 3> n = normal_of(face);
    const FacesAcross &view = others.across(contact_axes(n));
    for (unsigned int f = 0; f < other.size(); ++f)
      result.look_at_each_other = result.look_at_each_other || view.is_seen(f);
    const FacePlane plane = view.plane_of(face);
    for (const FacesAcross::Part &part : view.opposite(face))
    {
      const Tensor<1, 3> m = normal_of(other[part.opposite]), slope = -1. / (n * m) * m;
      const Point<3> &at = other[part.opposite][0];
      if (facing.covered == 0)
      {
        facing.at = at;
        facing.slope = slope;
      }
      facing.covered += area_of(part.polygon) / area_of(face);
      for (const Point<2> &corner : part.polygon)
      {
        const Point<3> x = plane.point(corner);
        const double distance = slope * (x - at);
        if (std::abs(distance - facing.slope * (x - facing.at)) > hair)
          result.step = x;
        if (distance < result.least)
        {
          result.least = distance;
          result.at_least = x;
        }
        result.largest = std::max(result.largest, distance);
      }
    }
  }
  return result;
}
} // namespace hpvi
