// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_geometry_h
#define hpvi_geometry_h

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/lac/vector.h>

#include <hpvi/scene/coarse_mesh.h>
#include <hpvi/scene/curved_face.h>

#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace hpvi
{
/** By boundary id, of a box and a quadrilateral: the one list of them. */
std::vector<std::string> boundary_names(int dim);

enum class Shape
{
  box,
  quadrilateral,
  ring_sector,
  half_disc,
  plate_with_hole,
  file,
  bodies ///< several, each of one of the other shapes
};

template <int dim>
using Corners = std::array<dealii::Point<dim>, dealii::GeometryInfo<dim>::vertices_per_cell>;

/** The corners of a box from those with the smallest and the largest coordinates. */
template <int dim>
Corners<dim> box_corners(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper);

/** The corners of a quadrilateral, given counterclockwise from the bottom left. */
Corners<2> quadrilateral_corners(const std::array<dealii::Point<2>, 4> &around);

/** One of several bodies. */
template <int dim>
struct Body
{
  std::string name;
  std::vector<unsigned int> sides; ///< its boundaries, by id
  std::vector<dealii::Point<dim>> graded_towards;
  unsigned int grading_levels = 0;
};

/**
 * The coarse mesh: a box or a convex quadrilateral, cut into a regular grid, or cells one by one; then graded.
 */
template <int dim>
struct Geometry
{
  Geometry(); ///< the unit box of one cell

  /** The d-linear image of @p unit in [0,1]^dim. */
  dealii::Point<dim> point(const dealii::Point<dim> &unit) const;

  /** Has it a mesh of its own in the place of a regular grid? */
  bool has_mesh() const;

  bool has_curves() const; ///< is any edge curved?

  /** By boundary id. */
  std::vector<std::string> boundary_names() const;

  /** Are all cells images of a square under an affine map? */
  bool has_affine_cells() const;

  double diameter() const;           ///< the largest distance of two points of the body [length]
  double radius() const;             ///< the largest distance of one from the centre [length]
  dealii::Point<dim> centre() const; ///< the mean of the corners
  bool contains(const dealii::Point<dim> &x) const; ///< up to round-off

  double n_cells() const; ///< of the coarse mesh before it is graded

  /** All grid lines across @p direction, where they cut that axis of the unit cube, from 0 to 1. */
  std::vector<double> grid_lines(unsigned int direction) const;

  /** Of a grid in one direction; of a mesh the root of their number. */
  unsigned int n_cells(unsigned int direction) const;

  Shape shape = Shape::box;
  /** In the place of corners, subdivisions and cuts; null: these make a grid. In the plane. */
  std::shared_ptr<const CoarseMesh> mesh;
  /** Corners in deal.II's lexicographic order (bottom left, bottom right, top left, top right); of a mesh its bounding box. */
  Corners<dim> corners;
  std::array<unsigned int, dim> subdivisions;
  /** Grid lines beside the equidistant ones, for what ends between these: in (0,1), ascending. */
  std::array<std::vector<double>, dim> cuts;
  /** Cells that touch one of these points are bisected @p grading_levels times. */
  std::vector<dealii::Point<dim>> graded_towards;
  unsigned int grading_levels = 0;
  /** Where there are several: the mesh holds the cells of all, each with the number of its body. */
  std::vector<Body<dim>> bodies;

  /** The index of that with the side number @p side; 0 where there is one body. */
  unsigned int body_of_side(unsigned int side) const;
};

/** A named part of the boundary: of a grid a flat side, an edge in the plane, a parallelogram in space. */
template <int dim>
struct Side
{
  static constexpr unsigned int n_corners = 1u << (dim - 1);

  using Piece = std::array<dealii::Point<dim>, n_corners>; ///< its corners

  /** Of what it consists: one, unless boundaries are parts of sides; none where they take it all; of a mesh its edges. */
  std::vector<Piece> pieces;
  using Curve = std::conditional_t<dim == 2, CurvePiece, CurvedFace>;

  /** What pieces follow between their corners, piece by piece; empty: all are straight or plane. */
  std::vector<Curve> curves;
  unsigned int axis =
      0; ///< of a grid: direction of Geometry::subdivisions in which no cells stand along it

  dealii::Tensor<1, dim> normal(const dealii::Point<dim> &x) const; ///< outer unit normal there

  /** t = (-n_y, n_x) there, in the plane. */
  dealii::Tensor<1, dim> tangent(const dealii::Point<dim> &x) const;

  /** Equidistant points all over each piece, their corners exactly. */
  std::vector<dealii::Point<dim>> sample() const;

  /** At s in [0,1] of a piece in the plane. */
  dealii::Point<dim> point(unsigned int piece, double s) const;

  /** The outer unit normal of a piece in the plane at s in [0,1]. */
  dealii::Tensor<1, dim> normal(unsigned int piece, double s) const;

  /** That of a piece where it is nearest to @p x. */
  dealii::Tensor<1, dim> normal(unsigned int piece, const dealii::Point<dim> &x) const;

  double distance(unsigned int piece, const dealii::Point<dim> &x) const;

  /** Holds a piece, with some room. */
  dealii::BoundingBox<dim> box(unsigned int piece) const;

  Curve curve(unsigned int piece) const; ///< none: straight or plane

  bool is_flat() const; ///< has it one normal?

  /** Of a flat side; of pieces of a mesh nothing, they have their own. */
  dealii::Tensor<1, dim> outward;
};

/** The mean of its corners. */
template <int dim>
dealii::Point<dim> centre_of(const typename Side<dim>::Piece &piece)
{
  dealii::Point<dim> result;
  for (const dealii::Point<dim> &corner : piece)
    result += corner / double(piece.size());
  return result;
}

/** All sides by boundary id. */
template <int dim>
std::vector<Side<dim>> sides_of(const Geometry<dim> &geometry);

/** Where two sides meet: ends of pieces in the plane, equidistant points of edges in space; empty: nowhere. */
template <int dim>
std::vector<dealii::Point<dim>> common_points(const Side<dim> &one, const Side<dim> &two);

/** Points all over the body, its boundary included. */
template <int dim>
std::vector<dealii::Point<dim>> sample_body(const Geometry<dim> &geometry);

/** A corner of the body with its angle. */
struct Corner
{
  dealii::Point<2> at;
  double degrees;
};

/** Where its boundary turns, of the angle inside the body; smooth curves have none. */
std::vector<Corner> corners_of(const Geometry<2> &geometry);

/** The numbers of two bodies that touch at a point, the slave first; no_body: a rigid foundation. */
using TouchingBodies = std::array<unsigned int, 2>;
constexpr unsigned int no_body = dealii::numbers::invalid_unsigned_int;

/**
 * A displacement that strains nothing: `translation + rotation e_z x (x - centre)`; where there are several bodies one of
 * each.
 */
template <int dim>
struct RigidBodyMotion
{
  dealii::Tensor<1, dim> translation; ///< dimensionless
  double rotation = 0;                ///< [1/length]
  dealii::Point<dim> centre;
  std::string name = {};                         ///< of the body, where there are several
  std::vector<RigidBodyMotion<dim>> others = {}; ///< those of the bodies 1, 2, ...

  dealii::Tensor<1, dim> at(const dealii::Point<dim> &x, unsigned int body = 0) const;

  /** What the first of two bodies does less the other. */
  dealii::Tensor<1, dim> jump(const dealii::Point<dim> &x, const TouchingBodies &bodies) const;

  bool is_translation() const; ///< does none turn?

  /** As in "along (1 0)" or "about (0.5 2)", of several bodies "punch along (1 0)". */
  std::string direction() const;

  void add(double factor,
           const RigidBodyMotion<dim> &other); ///< which has the same bodies and centres

  double largest_translation() const, largest_rotation() const; ///< absolute values, of all bodies
};

/** The sum of @p motions, which have one centre, times @p coefficients. */
template <int dim>
RigidBodyMotion<dim> sum(const std::vector<RigidBodyMotion<dim>> &motions,
                         const dealii::Vector<double> &coefficients);

/** The same where round-off in coefficients counts as zero. */
template <int dim>
RigidBodyMotion<dim> combined(const std::vector<RigidBodyMotion<dim>> &motions,
                              const dealii::Vector<double> &coefficients);
} // namespace hpvi

#endif
