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

/** A straight edge of a plane body. */
struct Edge
{
  std::array<unsigned int, 2> corners; ///< indices into Geometry::corners
  std::array<dealii::Point<2>, 2> ends;
  dealii::Tensor<1, 2> normal; ///< outer unit normal

  /** Equidistant points from end to end. */
  std::vector<dealii::Point<2>> sample() const;
};

/** The four edges by boundary id. */
std::vector<Edge> edges_of(const Geometry<2> &geometry);

/** Points all over the body, its boundary included. */
template <int dim>
std::vector<dealii::Point<dim>> sample_body(const Geometry<dim> &geometry);

/** Points all over one of its sides, by boundary id: Edge::sample() in the plane. */
std::vector<dealii::Point<2>> sample_side(const Geometry<2> &geometry, unsigned int side);
std::vector<dealii::Point<3>> sample_side(const Geometry<3> &geometry, unsigned int side);

/** The angles of the body at its corners, in degrees and in the order of the corners. */
std::array<double, 4> corner_angles(const Geometry<2> &geometry);

/** The mean of the corners. */
dealii::Point<2> centre_of(const Geometry<2> &geometry);

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
