// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_dof_h
#define hpvi_contact_dof_h

#include <hpvi/scene/contact_axes.h>
#include <hpvi/scene/friction_limit.h>
#include <hpvi/space/box_tables.h>

#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>

#include <array>
#include <memory>
#include <vector>

namespace hpvi
{
/**
 * A vector along a contact face, its components those of ContactAxes::tangents; or, of a pressure, one number
 * along the outer normal, the first component.
 */
template <int dim>
using ContactVector = dealii::Tensor<1, dim - 1>;

/**
 * What acts at one Gauss point of a contact face against the contact dof m of the displacement, by a multiplier
 * in a convex set whose force is `G lambda`:
 *
 *     friction   G |m - u_0|             |lambda| <= 1, a disc     G = g(x_k) int psi_k
 *     pressure   m <= u_0, else infinity  lambda >= 0 [stress]      G = int psi_k
 *     reaction   m = u_0, else infinity   lambda of any sign        likewise
 *     glue       m = 0, else infinity     any vector lambda         likewise, along the face
 *
 * The gap u_0 is a contact dof as well, of friction that of the load step before. Where the law of friction knows the pressure, `g(x_k)` is its limit for that of the
 * #partner, and a reaction is the pressure of bilateral contact. Where another body lies opposite, m is a moment of the jump.
 */
template <int dim>
struct ContactDof
{
  enum class Kind
  {
    friction,
    pressure,
    reaction,
    glue
  };

  Kind kind;
  dealii::Point<dim> x;
  dealii::Point<dim> centroid; ///< `int psi_k x / int psi_k`, where the force acts
  double area;                 ///< int psi_k [length^(dim-1)]
  double bound = 1;            ///< g(x) [stress] of friction; with a #partner without pressure
  double weight = 0;           ///< G [force], of a pressure [area]
  ContactVector<dim> gap;      ///< u_0, of friction the past slip [length]
  double sign = 1;             ///< of the outer normal along its unknown, of a pressure
  std::array<unsigned int, dim - 1> unknowns; ///< of its contact dofs among those of this process

  FrictionLimit limit; ///< of friction
  /** Of friction whose law knows the pressure: that of the same point, in PrimalSpace::contact; else invalid. */
  unsigned int partner = dealii::numbers::invalid_unsigned_int;

  bool is_friction() const
  {
    return kind == Kind::friction;
  }

  bool is_tangential() const
  {
    return kind == Kind::friction || kind == Kind::glue;
  }

  bool has_partner() const
  {
    return partner != dealii::numbers::invalid_unsigned_int;
  }

  /** What a unit of lambda is [stress], where all multipliers are @p lambda; of a pressure 1. */
  double bound_by(const std::vector<ContactVector<dim>> &lambda) const
  {
    return has_partner() ? limit.limit(lambda[partner][0]) : bound;
  }

  unsigned int n_unknowns() const
  {
    return is_tangential() ? dim - 1 : 1;
  }

  /** The projection onto the set of multipliers. */
  ContactVector<dim> projected(const ContactVector<dim> &z) const;

  /** Of `z = lambda + c (m - u_0)`: is m held, because a disc sticks or a pressure acts? */
  bool holds(const ContactVector<dim> &z) const;
};

/**
 * A face with contact dofs, those of its Gauss points one after the other from #friction and #pressure on. The unknowns at an inner
 * node are components along the axes of coordinates; where the normal is along none of these they are, all of them contact dofs,
 * those along the tangents and the normal. Of a curved face they turn: FaceContactDofs changes all components at once.
 */
template <int dim>
struct ContactDofFace
{
  typename dealii::DoFHandler<dim>::active_cell_iterator cell;
  unsigned int face;
  ContactAxes<dim> axes;
  std::shared_ptr<const FaceContactDofs> own =
      nullptr;                           ///< null: those of the unit face, its measure is constant
  std::vector<ContactAxes<dim>> turning; ///< of a curved face, at its Gauss points; none: #axes
  unsigned int friction = dealii::numbers::invalid_unsigned_int; ///< which means that there is none
  unsigned int pressure = dealii::numbers::invalid_unsigned_int; ///< likewise

  bool has_friction() const
  {
    return friction != dealii::numbers::invalid_unsigned_int;
  }

  bool has_pressure() const
  {
    return pressure != dealii::numbers::invalid_unsigned_int;
  }

  unsigned int first() const ///< of its contact dofs
  {
    return has_friction() ? friction : pressure;
  }

  std::vector<unsigned int> components() const; ///< which of those at inner nodes are contact dofs

  unsigned int tangential(unsigned int s) const; ///< the component of a tangent
  unsigned int normal() const;                   ///< the component of the normal
  dealii::Tensor<1, dim>
  direction(unsigned int component) const; ///< the same all along a flat face

  bool is_curved() const
  {
    return !turning.empty();
  }

  const ContactAxes<dim> &axes_at(unsigned int k) const ///< at a Gauss point
  {
    return is_curved() ? turning[k] : axes;
  }

  /** Likewise that of an own component. */
  dealii::Tensor<1, dim> direction(unsigned int component, unsigned int k) const;

  /** Of the outer normal along direction(normal()). */
  double sign() const
  {
    return axes.normal * direction(normal());
  }
};
} // namespace hpvi

#endif
