// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_faces_across_h
#define hpvi_faces_across_h

#include <hpvi/scene/common_part.h>
#include <hpvi/scene/contact_axes.h>
#include <hpvi/scene/geometry.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace hpvi
{
constexpr double uncovered_share =
    1e-6; ///< of a face: what round-off at the ends of sides may leave

/** Two coordinates in a plane across a normal. */
struct FacePlane
{
  dealii::Point<3> origin;
  ContactAxes<3> axes;

  dealii::Point<2> at(const dealii::Point<3> &x) const;
  dealii::Point<3> point(const dealii::Point<2> &x) const; ///< in the plane
  ConvexPolygon polygon(const Side<3>::Piece &face) const; ///< its shadow along the normal
};

/** Faces as seen along one normal, in squares of a grid: of thousands a few are looked at. */
class FacesAcross
{
public:
  /** A part of a face with another one opposite to it. */
  struct Part
  {
    unsigned int opposite; ///< number of that face
    ConvexPolygon polygon; ///< in coordinates of plane_of() of the first
  };

  /** Of @p faces, plane and convex, with their outer normals, those count that look against @p axes.normal. */
  FacesAcross(const std::vector<Side<3>::Piece> &faces, const ContactAxes<3> &axes);

  FacePlane plane_of(const Side<3>::Piece &face) const; ///< its first corner is the origin

  /** What lies opposite to @p face, across this normal, along which @p counts says of the others whether to take them. */
  std::vector<Part> opposite(
      const Side<3>::Piece &face,
      const std::function<bool(unsigned int)> &counts = [](unsigned int) { return true; }) const;

  const dealii::Tensor<1, 3> &normal() const
  {
    return plane.axes.normal;
  }

  bool is_seen(const unsigned int face) const
  {
    return !polygons[face].empty();
  }

private:
  std::set<unsigned int> beside(const ConvexPolygon &polygon) const;
  template <class Take>
  void for_squares(const ConvexPolygon &polygon, const Take &take) const;

  const FacePlane plane;
  std::vector<ConvexPolygon> polygons; ///< by face; empty: it looks away
  double width = 1;                    ///< of a square [length]
  std::map<std::array<long, 2>, std::vector<unsigned int>> by_square;
};
/** The same along any normal. */
class FacesFromAll
{
public:
  explicit FacesFromAll(std::vector<Side<3>::Piece> faces);

  const std::vector<Side<3>::Piece> faces;
  const FacesAcross &across(const ContactAxes<3> &axes) const;

private:
  mutable std::vector<std::unique_ptr<const FacesAcross>> known; ///< as far as they were asked for
};

/** What lies opposite to the faces of one side in space on another side, along the normal of each face. */
struct SidesFacing
{
  struct Face
  {
    double covered = 0; ///< share that has something opposite
    dealii::Point<3> at;
    dealii::Tensor<1, 3>
        slope; ///< of the distance to what is opposite, slope (x - at) [dimensionless]
  };

  std::vector<Face> faces;
  bool look_at_each_other = false; ///< is any face seen from any?
  double least = 0, largest = 0;   ///< distance, negative where they lie inside each other [length]
  dealii::Point<3> at_least;
  std::optional<dealii::Point<3>> step; ///< where a face has several planes opposite

  bool any() const; ///< does anything lie opposite?

  /** Does all of each face of the pair lie opposite to the other side, once? */
  bool are_covered() const;
};

/** Planes count as one to @p hair [length]. */
SidesFacing facing_faces(const std::vector<Side<3>::Piece> &own,
                         const std::vector<Side<3>::Piece> &other, double hair);
} // namespace hpvi

#endif
