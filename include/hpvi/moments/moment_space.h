// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_moment_space_h
#define hpvi_moment_space_h

#include <hpvi/moments/box_tables.h>
#include <hpvi/moments/processes.h>
#include <hpvi/scene/scene.h>

#include <deal.II/base/index_set.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * A vector along a contact face, its components those of tangents(); or, of a pressure, one number
 * along the outer normal, the first component.
 */
template <int dim>
using ContactVector = dealii::Tensor<1, dim - 1>;

/**
 * What acts at one Gauss point of a contact face against the moment m of the displacement, by a multiplier
 * in a convex set whose force is `G lambda`:
 *
 *     friction   G |m|                   |lambda| <= 1, a disc     G = g(x_k) int psi_k
 *     pressure   m <= u_0, else infinity  lambda >= 0 [stress]      G = int psi_k
 *
 * The gap u_0 is a moment as well.
 */
template <int dim>
struct ContactMoment
{
  enum class Kind
  {
    friction,
    pressure
  };

  Kind kind;
  dealii::Point<dim> x;
  double area;                                ///< int psi_k [length^(dim-1)]
  double bound = 1;                           ///< g(x) [stress] of friction
  double weight = 0;                          ///< G [force], of a pressure [area]
  ContactVector<dim> gap;                     ///< u_0 where a pressure acts, else 0 [length]
  double sign = 1;                            ///< of the outer normal along its axis, of a pressure
  std::array<unsigned int, dim - 1> unknowns; ///< of its moments among those of this process

  bool is_friction() const
  {
    return kind == Kind::friction;
  }

  unsigned int n_unknowns() const
  {
    return is_friction() ? dim - 1 : 1;
  }

  /** The projection onto the set of multipliers. */
  ContactVector<dim> projected(const ContactVector<dim> &z) const;

  /** Of `z = lambda + c (m - u_0)`: is m held, because a disc sticks or a pressure acts? */
  bool holds(const ContactVector<dim> &z) const;
};

/** A face with moments, those of its Gauss points one after the other from #friction and #pressure on. */
template <int dim>
struct MomentFace
{
  typename dealii::DoFHandler<dim>::active_cell_iterator cell;
  unsigned int face;
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

  std::vector<unsigned int> axes() const; ///< the components that have moments
};

/**
 * The displacements of one degree on a distributed mesh of boxes, in the basis in which contact is
 * diagonal: moments stand for the inner nodal values of tangential components on faces with friction, and of
 * the normal one on faces of unilateral contact (see BoxTables). Moments belong to one cell, never hang and
 * are never prescribed.
 *
 * A field has two vectors: v in the basis of moments, constrained unknowns zero; u of nodal values,
 * complete, with those of neighbouring cells of other processes.
 */
template <int dim>
class MomentSpace
{
public:
  using Mesh = dealii::parallel::distributed::Triangulation<dim>;
  using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

  /** Collective. Throws InputError where an expression of the scene is not what it has to be. */
  MomentSpace(const Scene<dim> &scene, const Mesh &mesh, const BoxTables<dim> &tables);

  MPI_Comm communicator() const;
  DistributedVector owned_vector() const;   ///< zero, for v
  DistributedVector ghosted_vector() const; ///< zero, for u; can be written

  DistributedVector displacement(const DistributedVector &v) const; ///< u of v
  DistributedVector moments(const DistributedVector &u) const;      ///< v of u

  ContactVector<dim> moment(const DistributedVector &v, unsigned int k) const; ///< of #contact
  void add_moment(DistributedVector &v, unsigned int k, const ContactVector<dim> &value) const;
  void set_moment(DistributedVector &v, unsigned int k, const ContactVector<dim> &value) const;

  /** u on @p cell, of this process or beside it. */
  CellField<dim> field(const Cell &cell, const DistributedVector &u) const;

  /** Lengths of the edges of @p cell. */
  static dealii::Tensor<1, dim>
  extent(const typename dealii::Triangulation<dim>::cell_iterator &cell);

  /** Where the point @p unit of the unit cell lies in @p cell. */
  static dealii::Point<dim> point_of(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                                     const dealii::Point<dim> &unit);

  const BoundaryCondition<dim> &condition(const Cell &cell, unsigned int face) const;

  /** Does component @p c of a face of @p cell, active or not, have moments? At `dim face + c`. */
  std::vector<bool>
  moment_components(const typename dealii::Triangulation<dim>::cell_iterator &cell) const;

  /** A face of this process; null: it has no moments. */
  const MomentFace<dim> *moment_face(const Cell &cell, unsigned int face) const;

  const Scene<dim> &scene;
  const BoxTables<dim> &tables;
  dealii::DoFHandler<dim> dof_handler;
  dealii::IndexSet owned, relevant;
  dealii::AffineConstraints<double> constraints;
  std::vector<MomentFace<dim>> faces;      ///< of this process, as the next
  std::vector<ContactMoment<dim>> contact; ///< what acts at its Gauss points
  dealii::types::global_dof_index n_free;  ///< of all processes, as all that follows
  dealii::types::global_dof_index n_discs;
  dealii::types::global_dof_index n_pressures;

  dealii::types::global_dof_index n_multipliers() const
  {
    return (dim - 1) * n_discs + n_pressures;
  }

private:
  void number();
  void constrain();
  void find_contact();
  void add_friction(MomentFace<dim> &face,
                    const std::vector<dealii::types::global_dof_index> &dofs);
  void add_pressures(MomentFace<dim> &face,
                     const std::vector<dealii::types::global_dof_index> &dofs);
  double moment_of_gap(const MomentFace<dim> &face, unsigned int k) const;
  dealii::types::global_dof_index dof(const std::vector<dealii::types::global_dof_index> &dofs,
                                      unsigned int shape, unsigned int component) const;

  std::map<std::pair<unsigned int, unsigned int>, unsigned int> face_numbers; ///< by cell, face
};
} // namespace hpvi

#endif
