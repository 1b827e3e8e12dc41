// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_boundary_condition_h
#define hpvi_boundary_condition_h

#include <hpvi/scene/expression.h>
#include <hpvi/scene/friction_law.h>
#include <hpvi/scene/rigid_plate.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * What a plane below a boundary asks of it. Where another body takes the place of the plane, u stands for the jump
 * [u] = u - u', u' the displacement of the other body opposite.
 */
enum class Contact
{
  none,
  bilateral,  ///< u_n = 0
  unilateral, ///< u_n <= u_0, T_n <= 0, (u_n - u_0) T_n = 0
  tangential, ///< nothing in the normal direction; friction alone acts
  tied        ///< of two bodies: u = 0, glued
};

/** An elastic foundation, glued to the body: the traction -k_n u_n n - k_t u_t on it, whichever way it moves. */
template <int dim>
struct Spring
{
  Expression<dim> normal, tangential; ///< k_n, k_t >= 0 [stress/length]; null: zero

  explicit operator bool() const
  {
    return normal || tangential;
  }

  std::array<double, 2> at(const dealii::Point<dim> &x) const; ///< k_n and k_t there
  bool varies() const;                                         ///< is one of them no constant?

  /** `k_n n n' + k_t (I - n n')` there: -traction = stiffness u [stress/length]. */
  dealii::Tensor<2, dim> stiffness(const dealii::Point<dim> &x,
                                   const dealii::Tensor<1, dim> &n) const;
};

/** Everything that a scene says about one named part of the boundary. */
template <int dim>
struct BoundaryCondition
{
  using Expression = hpvi::Expression<dim>;

  std::string name;                  ///< left, right, bottom, top, front, back, or that of a part
  dealii::types::boundary_id id = 0; ///< deal.II's number: the index into Scene::boundaries
  unsigned int side = 0;             ///< id of the side of the body: its own, unless it is a part
  Expression where;                  ///< a part has the faces of the side where this is positive
  std::array<Expression, dim> displacement; ///< prescribed components u_D [length]; null: free
  Load<dim> traction;                       ///< components of G [stress]; null: zero
  bool symmetry = false;                    ///< u_n = 0 without friction, a plane of symmetry
  Spring<dim> spring;
  std::optional<RigidPlate<dim>> plate;
  Contact contact = Contact::none;
  Expression gap; ///< u_0(x) of unilateral contact [length], negative: interference; null: 0
  FrictionLaw<dim> friction;
  double wear = 0; ///< Archard's k: the depth k int max(0, -T_n) |ds| is worn off [1/stress]
  /** A unit vector d out of the body along which contact is measured; nothing: the normal. */
  std::optional<dealii::Tensor<1, dim>> contact_direction;
  std::optional<unsigned int> pair; ///< where it meets another body: the index into Scene::pairs
  std::string pair_name;            ///< its name

  bool has_displacement() const; ///< is any component prescribed?
  bool has_traction() const;     ///< is any component given?
  bool exerts_forces() const;    ///< a support, plate, contact or springs?
  bool has_contact() const;      ///< with a foundation or another body
  bool is_unilateral() const;
  bool is_tied() const;
  /** u_n = 0 as a constraint of the space: symmetry; bilateral contact whose friction knows no pressure. */
  bool holds_normal() const;
  bool has_pressure()
      const; ///< a multiplier of its own for T_n: unilateral, or friction knows the pressure
  double gap_at(const dealii::Point<dim> &x) const; ///< u_0(x)
  /** Along which contact and symmetry measure u_n, where the body has @p normal. */
  dealii::Tensor<1, dim> held_direction(const dealii::Tensor<1, dim> &normal) const;
};

/** `direction . u = value` at one point, said by one boundary. */
template <int dim>
struct PointCondition
{
  dealii::Tensor<1, dim> direction; ///< unit vector
  double value;                     ///< [length]
  unsigned int boundary;
};

/** What a boundary with outer @p normal prescribes at @p point: displacements, and `u_n = 0` where it @p slides. */
template <int dim>
std::vector<PointCondition<dim>> conditions_at(const BoundaryCondition<dim> &boundary,
                                               const dealii::Tensor<1, dim> &normal, bool slides,
                                               const dealii::Point<dim> &point);
} // namespace hpvi

#endif
