// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_curved_facing_h
#define hpvi_curved_facing_h

#include <hpvi/scene/box_tree.h>
#include <hpvi/scene/curved_face.h>
#include <hpvi/scene/faces_across.h>

#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace hpvi
{
/** A plane face as one of second order. */
CurvedFace flat_face(const Side<3>::Piece &corners);

/** Where the line `x + h n` meets a face. */
struct FaceMeeting
{
  dealii::Point<2> xi;
  double distance; ///< h [length]
};

/**
 * Of a face, or of what continues it up to @p beyond of its coordinates, by Newton's method from @p start; null where they do not
 * meet there.
 */
std::optional<FaceMeeting> meeting(const CurvedFace &face, const dealii::Point<3> &x,
                                   const dealii::Tensor<1, 3> &n, double beyond,
                                   const dealii::Point<2> &start = {0.5, 0.5});

/** xi at which the normal of a face, or of what continues it, goes through @p y; null where Newton's method finds none. */
std::optional<dealii::Point<2>> foot(const CurvedFace &face, const dealii::Point<3> &y);

/** Faces of a side that are curved, and what lies opposite to them along normals that turn. */
class CurvedFaces
{
public:
  /** One at least. */
  explicit CurvedFaces(std::vector<CurvedFace> faces);

  const CurvedFace &operator[](const unsigned int face) const
  {
    return faces[face];
  }

  unsigned int size() const
  {
    return faces.size();
  }

  unsigned int nearest(const dealii::Point<3> &x) const; ///< the face

  struct Opposite
  {
    unsigned int face;
    FaceMeeting at;
  };

  using Counts = std::function<bool(unsigned int)>; ///< says of a face whether to take it

  /** The nearest face, either way, that looks against @p n where `x + h n` meets it. */
  std::optional<Opposite> opposite(
      const dealii::Point<3> &x, const dealii::Tensor<1, 3> &n,
      const Counts &counts = [](unsigned int) { return true; }) const;

  /**
   * The parts of @p own, in its coordinates, with one face opposite each. Edges of the faces become polygons by their feet on @p own, the
   * same for both faces of an edge; polygons may be a little concave.
   */
  std::vector<FacesAcross::Part> parts(const CurvedFace &own, const Counts &counts) const;

private:
  std::vector<unsigned int> candidates(const CurvedFace &own, const Counts &counts) const;

  const std::vector<CurvedFace> faces;
  const BoxTree<3> tree;
};

/** What lies opposite to the faces of one side on another one, along normals that turn, as seen from points of a grid on each face. */
struct CurvedFacing
{
  struct Face
  {
    double covered = 0; ///< share of points inside that see the other side
    double least =
        std::numeric_limits<double>::max(); ///< distance [length]; of none the largest number
    double largest = std::numeric_limits<double>::lowest();
    dealii::Point<3> at_least;

    bool is_covered() const
    {
      return covered == 1;
    }
  };

  CurvedFacing(const CurvedFaces &own, const CurvedFaces &other);

  bool any() const; ///< does anything lie opposite?

  std::vector<Face> faces;
  std::vector<bool> is_seen; ///< by face of the other side
};
} // namespace hpvi

#endif
