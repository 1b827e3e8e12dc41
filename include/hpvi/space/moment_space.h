// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_moment_space_h
#define hpvi_moment_space_h

#include <hpvi/base/processes.h>
#include <hpvi/scene/scene.h>
#include <hpvi/space/box_tables.h>
#include <hpvi/space/contact_moment.h>

#include <deal.II/base/index_set.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * The displacements of one degree on a distributed mesh of hexahedra, in the plane of boxes, in the basis in which contact is
 * diagonal: moments stand for the inner nodal values of tangential components on faces with friction, and of
 * the normal one where contact has a pressure (see BoxTables). Moments belong to one cell, never hang and
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

  /** Lengths of the edges of @p cell, a box. */
  static dealii::Tensor<1, dim>
  extent(const typename dealii::Triangulation<dim>::cell_iterator &cell);

  /** Where the point @p unit of the unit cell lies in @p cell. */
  static dealii::Point<dim> point_of(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                                     const dealii::Point<dim> &unit);

  const BoundaryCondition<dim> &condition(const Cell &cell, unsigned int face) const;

  /**
   * Does a face of @p cell, active or not, have moments? Of its normal component at `dim face + face/2`, and of those along
   * it, at its other numbers.
   */
  std::vector<bool>
  moment_components(const typename dealii::Triangulation<dim>::cell_iterator &cell) const;

  /** The change to moments on @p face. */
  const FaceMoments &moments_on(const MomentFace<dim> &face) const
  {
    return face.own ? *face.own : tables.moments;
  }

  /**
   * Does anything act, or hang on springs, along a boundary? Where contact alone holds the body each of its pressures has
   * moments beside it.
   */
  bool has_tangential_moments(const BoundaryCondition<dim> &boundary) const
  {
    return boundary.has_contact() &&
           (boundary.friction || (rests_on_contact && boundary.is_unilateral()));
  }

  /** A face of this process; null: it has no moments. */
  const MomentFace<dim> *moment_face(const Cell &cell, unsigned int face) const;

  /** Friction counts the moments of @p u, with those of neighbours, for no slip: that of the load step before. */
  void count_slip_from(const DistributedVector &u);

  const Scene<dim> &scene;
  const BoxTables<dim> &tables;
  const bool rests_on_contact; ///< do supports leave motions free? In space alone
  dealii::DoFHandler<dim> dof_handler;
  dealii::IndexSet owned, relevant;
  dealii::AffineConstraints<double> constraints;
  std::vector<MomentFace<dim>> faces;      ///< of this process, as the next
  std::vector<ContactMoment<dim>> contact; ///< what acts at its Gauss points
  std::optional<DistributedVector> past;   ///< of count_slip_from()
  dealii::types::global_dof_index n_free;  ///< of all processes, as all that follows
  dealii::types::global_dof_index n_discs;
  dealii::types::global_dof_index n_pressures;

  dealii::types::global_dof_index n_multipliers() const
  {
    return (dim - 1) * n_discs + n_pressures;
  }

private:
  void number();
  void find_contact();
  void add_moments(const MomentFace<dim> &face, typename ContactMoment<dim>::Kind kind,
                   const std::vector<dealii::types::global_dof_index> &dofs);
  template <typename Value>
  Value mean(const MomentFace<dim> &face, unsigned int k,
             const std::function<Value(const dealii::Point<dim> &)> &f) const;
  double gap_at(const MomentFace<dim> &face, const dealii::Point<dim> &x) const;
  MomentFace<dim> face_of(const Cell &cell, unsigned int number) const;
  dealii::types::global_dof_index dof(const std::vector<dealii::types::global_dof_index> &dofs,
                                      unsigned int shape, unsigned int component) const;

  std::map<std::pair<unsigned int, unsigned int>, unsigned int> face_numbers; ///< by cell, face
};
} // namespace hpvi

#endif
