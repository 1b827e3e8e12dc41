// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_field_h
#define hpvi_field_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/dofs/dof_handler.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/mortar_segmentation.h>
#include <hpvi/plane/shape_tables.h>
#include <hpvi/scene/scene.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace hpvi
{
/**
 * A vector along the contact: in the plane its component along `t = (-n_y, n_x)`, a number; in space
 * the vector itself, in the axes of the body.
 */
template <int dim>
using Tangential = std::conditional_t<dim == 2, double, dealii::Tensor<1, dim>>;

/** Its absolute value. */
inline double size_of(const double number)
{
  return std::abs(number);
}

template <int dim>
double size_of(const dealii::Tensor<1, dim> &vector)
{
  return vector.norm();
}

/** A face at one of its points. */
template <int dim>
struct FaceFrame
{
  dealii::Point<dim> x;
  dealii::Tensor<1, dim> normal; ///< outer unit normal n, or `Contact direction` d
  std::array<dealii::Tensor<1, dim>, dim - 1> tangents; ///< t = (-n_y, n_x); in space two
  double measure; ///< ds over that of the reference face; of axisymmetric bodies times 2 pi x

  /** Of components along the tangents. */
  Tangential<dim> tangential(const dealii::Tensor<1, dim - 1> &components) const;

  Tangential<dim> tangential(const dealii::Tensor<1, dim> &u) const; ///< u without its normal part
};

/** A face of the contact boundary, of a cell of this process. */
template <int dim>
struct FieldFace
{
  typename dealii::DoFHandler<dim>::active_cell_iterator cell;
  unsigned int face_no;
  const BoundaryCondition<dim> *condition;
  CellMap<dim> map;             ///< of the cell
  unsigned int number;          ///< of this in Field::faces()
  bool is_axisymmetric = false; ///< is it one of an axisymmetric body?

  unsigned int degree() const; ///< p_K of the cell

  double area() const; ///< [length^(dim-1)]: of an edge its length

  FaceFrame<dim> frame(const dealii::Point<dim> &reference) const; ///< at a point of the unit cell
};

/** What the multipliers say of the tractions `T_t = -friction, T_n = -pressure` at a point [stress]. */
template <int dim>
struct ContactTraction
{
  dealii::Tensor<1, dim - 1> friction; ///< z_N along the tangents of FaceFrame
  double pressure = 0;                 ///< 0 where contact has no multiplier for it
};

/** A point of a face at which multipliers have their values. */
template <int dim>
struct MultiplierPoint
{
  dealii::Point<dim> reference; ///< of the unit cell
  double area;                  ///< of the quadrature rule, times ds [length^(dim-1)]
  double bound;                 ///< g [stress], 0 without friction
  ContactTraction<dim> traction;
  bool is_open; ///< unilateral contact without pressure here, or at unknowns on both sides
};

/** What contact exerts on a part of a face of a master in space, at points of the face. */
template <int dim>
struct ExertedTraction
{
  typename dealii::DoFHandler<dim>::active_cell_iterator cell; ///< of the master, of this process
  unsigned int face_no;
  dealii::Tensor<1, dim> normal; ///< of the slave opposite, into the master
  std::vector<dealii::Point<dim>> references;
  std::vector<double> weights;                   ///< times ds
  std::vector<dealii::Tensor<1, dim>> tractions; ///< on the master [stress]
};

/** A pressure by itself. */
template <int dim>
struct PressureValue
{
  dealii::Point<dim> x;
  double pressure; ///< positive presses [stress]
};

/** u_N and its stress somewhere. */
template <int dim>
struct PointValue
{
  dealii::Tensor<1, dim> displacement;    ///< [length]
  dealii::SymmetricTensor<2, dim> stress; ///< [stress]
  double across = 0; ///< sigma_zz in the plane, around the axis of an axisymmetric body; in space 0
};

/** The point of the unit cell that lies at @p x, up to 1e-9 of the cell; null: @p cell has none. */
template <int dim>
std::optional<dealii::Point<dim>>
reference_of(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
             const dealii::Point<dim> &x);

/**
 * u_N and the tractions of contact as values at points of the cells of this process, whichever backend has
 * found them: all of `evaluation`, `peaks` and `output` asks a field and knows no vector of unknowns. On one
 * process the cells of this process are all cells. What it is made of lives as long as it does.
 */
template <int dim>
class Field
{
public:
  using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

  virtual ~Field() = default;

  const Scene<dim> &scene;
  const ShapeTables<dim> &tables;
  const dealii::DoFHandler<dim> &dof_handler;

  MPI_Comm communicator() const;
  unsigned int degree(const Cell &cell) const; ///< p_K

  /**
   * Of u_N on a cell of this process or beside it, in the scalar FE_Q(p_K), component by component: entry
   * [c * n_shapes + i] belongs to component c and scalar shape function i. ShapeTables has the values of
   * these.
   */
  virtual std::vector<double> coefficients(const Cell &cell) const = 0;

  /** The largest nodal value of a component of u_N on all processes [length]; collective. */
  virtual double largest_displacement() const = 0;

  /** u_N and its stress at points of the unit cell, on a cell of this process. */
  std::vector<PointValue<dim>> values(const Cell &cell,
                                      const std::vector<dealii::Point<dim>> &references) const;

  /** u_N and its stress at @p x, for all processes; null outside the body. Collective. */
  std::optional<PointValue<dim>> at(const dealii::Point<dim> &x) const;

  /** Of this process; in the plane one contact boundary after the other, by place. */
  const std::vector<FieldFace<dim>> &faces() const;

  /** The tractions of contact at a point of the unit cell on @p face. */
  virtual ContactTraction<dim> traction(const FieldFace<dim> &face,
                                        const dealii::Point<dim> &reference) const = 0;

  /** What friction has there at most: g, or mu_f times the pressure [stress]. */
  virtual double bound(const FieldFace<dim> &face, const dealii::Point<dim> &reference) const = 0;

  /** u_t of the load step before, at @p x, from which slip is counted [length]. */
  virtual Tangential<dim> past_slip(const FieldFace<dim> &face,
                                    const dealii::Point<dim> &x) const = 0;

  /** Where another body lies opposite to @p face, its faces; none of a rigid foundation. */
  virtual std::vector<ContactSegment<dim>> segments(const FieldFace<dim> &face) const;

  /** u' of the other body opposite; of a rigid foundation 0: slip and gaps are those of the jump u - u' [length]. */
  virtual dealii::Tensor<1, dim> opposite(const FieldFace<dim> &face,
                                          const dealii::Point<dim> &reference) const;

  /** In space u' less that of the load step before [length]. */
  virtual dealii::Tensor<1, dim> change_opposite(const FieldFace<dim> &face,
                                                 const dealii::Point<dim> &reference) const;

  /** The materials of segments(), in space of what lies opposite on any process. */
  virtual std::vector<dealii::types::material_id>
  materials_opposite(const FieldFace<dim> &face) const;

  /** In space what contact exerts on masters of this process; none in the plane, which has segments(). */
  virtual const std::vector<ExertedTraction<dim>> &exerted() const;

  /** In the plane the places in [0,1] where integrals that hold g are cut, its ends included; none: no friction. */
  virtual std::vector<double> friction_cuts(const FieldFace<dim> &face) const = 0;

  /** At least one; a pressure is none up to @p negligible. multiplier_table() has their shape functions. */
  virtual std::vector<MultiplierPoint<dim>> multiplier_points(const FieldFace<dim> &face,
                                                              double negligible) const = 0;

  /** Of the points of multiplier_points(). */
  virtual const ShapeTable<dim> &multiplier_table(const FieldFace<dim> &face) const = 0;

  /** The unknowns of pressure of @p face. */
  virtual std::vector<PressureValue<dim>> pressures(const FieldFace<dim> &face) const = 0;

  /** `b(u_N, lambda_N) - int lambda_Nn u_0` [stress length^dim]; collective. */
  virtual double contact_work() const = 0;

  /**
   * A displacement that is random and as large as the last bit of u_N on each cell, without tractions, for
   * another scene @p unloaded.
   */
  virtual std::unique_ptr<const Field> round_off_probe(const Scene<dim> &unloaded) const = 0;

protected:
  Field(const Scene<dim> &scene, const ShapeTables<dim> &tables,
        const dealii::DoFHandler<dim> &dof_handler);

  void add_face(const Cell &cell, unsigned int face_no); ///< behind those that are there

private:
  std::vector<FieldFace<dim>> contact_faces;
  std::vector<ExertedTraction<dim>> nothing_exerted;
};

} // namespace hpvi

#endif
