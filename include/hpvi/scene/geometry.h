// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_geometry_h
#define hpvi_geometry_h

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <string>
#include <vector>

namespace hpvi
{
enum class Shape
{
  box,
  quadrilateral
};

template <int dim>
using Corners = std::array<dealii::Point<dim>, dealii::GeometryInfo<dim>::vertices_per_cell>;

/** The corners of a box from those with the smallest and the largest coordinates. */
template <int dim>
Corners<dim> box_corners(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper);

/** The corners of a quadrilateral, given counterclockwise from the bottom left. */
Corners<2> quadrilateral_corners(const std::array<dealii::Point<2>, 4> &around);

/** The coarse mesh: a box or a convex quadrilateral, cut into a regular grid, then graded. */
template <int dim>
struct Geometry
{
  Geometry(); ///< the unit box of one cell

  /** The d-linear image of @p unit in [0,1]^dim. */
  dealii::Point<dim> point(const dealii::Point<dim> &unit) const;

  /** Are all cells images of a square under an affine map? */
  bool has_affine_cells() const;

  Shape shape = Shape::box;
  /** Corners in deal.II's lexicographic order (bottom left, bottom right, top left, top right). */
  Corners<dim> corners;
  std::array<unsigned int, dim> subdivisions;
  /** Cells that touch one of these points are bisected @p grading_levels times. */
  std::vector<dealii::Point<dim>> graded_towards;
  unsigned int grading_levels = 0;
};

/** A flat side of the body: an edge in the plane, a parallelogram in space. */
template <int dim>
struct Side
{
  static constexpr unsigned int n_corners = 1u << (dim - 1);

  std::array<unsigned int, n_corners> corners; ///< indices into Geometry::corners
  std::array<dealii::Point<dim>, n_corners> ends;
  dealii::Tensor<1, dim> normal; ///< outer unit normal

  /** Equidistant points all over it, its corners exactly. */
  std::vector<dealii::Point<dim>> sample() const;
};

/** All sides by boundary id. */
template <int dim>
std::vector<Side<dim>> sides_of(const Geometry<dim> &geometry);

/** Where two sides meet: one corner in the plane, equidistant points of an edge in space; empty: nowhere. */
template <int dim>
std::vector<dealii::Point<dim>> common_points(const Side<dim> &one, const Side<dim> &two);

/** Points all over the body, its boundary included. */
template <int dim>
std::vector<dealii::Point<dim>> sample_body(const Geometry<dim> &geometry);

/** The angles of the body at its corners, in degrees and in the order of the corners. */
std::array<double, 4> corner_angles(const Geometry<2> &geometry);

/** The mean of the corners. */
template <int dim>
dealii::Point<dim> centre_of(const Geometry<dim> &geometry);

/** A displacement that strains nothing: `translation + rotation e_z x (x - centre)`. */
template <int dim>
struct RigidBodyMotion
{
  dealii::Tensor<1, dim> translation; ///< dimensionless
  double rotation = 0;                ///< [1/length]
  dealii::Point<dim> centre;

  dealii::Tensor<1, dim> at(const dealii::Point<dim> &x) const;
  bool is_translation() const;

  /** As in "along (1 0)" or "about (0.5 2)". */
  std::string direction() const;
};

/** The sum of @p motions, which have one centre, times @p coefficients; round-off in these counts as zero. */
template <int dim>
RigidBodyMotion<dim> combined(const std::vector<RigidBodyMotion<dim>> &motions,
                              const dealii::Vector<double> &coefficients);
} // namespace hpvi

#endif
