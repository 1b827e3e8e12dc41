// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_primal_space_h
#define hpvi_primal_space_h

#include <hpvi/base/processes.h>
#include <hpvi/scene/scene.h>
#include <hpvi/space/contact_dof.h>
#include <hpvi/space/degree_tables.h>
#include <hpvi/space/opposite_faces.h>
#include <hpvi/space/plate_constraints.h>

#include <deal.II/base/index_set.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * The displacements of one degree, or of one a body, on a distributed mesh of hexahedra, in the plane of boxes, in the basis in which contact is
 * diagonal: contact dofs stand for the inner nodal values of tangential components on faces with friction, and of
 * the normal one where contact has a pressure (see BoxTables). Contact dofs belong to one cell, never hang and
 * are never prescribed. Where two bodies touch in space one of them, the slave, has contact dofs: moments of the jump, see
 * OppositeFaces.
 *
 * A field has two vectors: v in the basis of contact dofs, constrained unknowns zero; u of nodal values,
 * complete, with those of neighbouring cells of other processes.
 */
template <int dim>
class PrimalSpace
{
public:
  using Mesh = dealii::parallel::distributed::Triangulation<dim>;
  using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

  /** Collective. Throws InputError where an expression of the scene is not what it has to be. */
  PrimalSpace(const Scene<dim> &scene, const Mesh &mesh, const DegreeTables<dim> &tables);

  MPI_Comm communicator() const;
  DistributedVector owned_vector() const;   ///< zero, for v
  DistributedVector ghosted_vector() const; ///< zero, for u; can be written

  DistributedVector displacement(const DistributedVector &v) const;    ///< u of v
  DistributedVector in_contact_dofs(const DistributedVector &u) const; ///< v of u

  ContactVector<dim> contact_value(const DistributedVector &v,
                                   unsigned int k) const; ///< of #contact
  void add_contact_value(DistributedVector &v, unsigned int k,
                         const ContactVector<dim> &value) const;
  void set_contact_value(DistributedVector &v, unsigned int k,
                         const ContactVector<dim> &value) const;

  /** u on @p cell, of this process or beside it. */
  CellField<dim> field(const Cell &cell, const DistributedVector &u) const;

  /** Lengths of the edges of @p cell, a box. */
  static dealii::Tensor<1, dim>
  extent(const typename dealii::Triangulation<dim>::cell_iterator &cell);

  const BoundaryCondition<dim> &condition(const Cell &cell, unsigned int face) const;

  /**
   * Does a face of @p cell, active or not, have contact dofs? Of its normal component at `dim face + face/2`, and of those along
   * it, at its other numbers.
   */
  std::vector<bool>
  moment_components(const typename dealii::Triangulation<dim>::cell_iterator &cell) const;

  /** The change to contact dofs on @p face. */
  const FaceContactDofs &contact_dofs_on(const ContactDofFace<dim> &face) const
  {
    return face.own ? *face.own : tables.of(face.cell).contact_dofs;
  }

  /**
   * Does anything act, or hang on springs, along a boundary? Where contact alone holds the body each of its pressures has
   * contact dofs beside it.
   */
  bool has_tangential_contact_dofs(const BoundaryCondition<dim> &boundary) const
  {
    return boundary.has_contact() && !is_master(boundary.id) &&
           (boundary.friction || boundary.is_tied() ||
            (rests_on_contact && boundary.is_unilateral()));
  }

  bool has_normal_contact_dofs(const BoundaryCondition<dim> &boundary) const
  {
    return boundary.has_pressure() && !is_master(boundary.id);
  }

  /** Is it a part of a pair of bodies that has no multipliers? */
  bool is_master(const dealii::types::boundary_id boundary) const
  {
    return !masters.empty() && masters[boundary];
  }

  /** May faces of it lie opposite to a slave? */
  bool is_opposite(const dealii::types::boundary_id boundary) const
  {
    return !opposite_to_any.empty() && opposite_to_any[boundary];
  }

  /** Has a pair to which it belongs a curved face, so that directions turn? */
  bool is_in_curved_pair(const BoundaryCondition<dim> &boundary) const
  {
    return boundary.pair && !curved.empty() && curved[*boundary.pair];
  }

  /** A face of this process; null: it has no contact dofs. */
  const ContactDofFace<dim> *moment_face(const Cell &cell, unsigned int face) const;

  /** Nodal values of u opposite to faces, for moment_opposite(); none where no bodies touch. Collective. */
  std::vector<double> values_opposite(const DistributedVector &u) const;

  /** `sum_d R_kd u_d` on a face by its number, of values_opposite(). */
  dealii::Tensor<1, dim> moment_opposite(unsigned int face, unsigned int k,
                                         const std::vector<double> &values) const;

  /** Of a curved face `sum_d R_kd u_d` along its directions e_i by i n + k, of values_opposite(). */
  dealii::Vector<double> moments_opposite(unsigned int face,
                                          const std::vector<double> &values) const;

  /** Friction counts the contact dofs of @p u, with those of neighbours, for no slip: that of the load step before. */
  void count_slip_from(const DistributedVector &u);

  const Scene<dim> &scene;
  const DegreeTables<dim> &tables;
  const bool rests_on_contact; ///< do supports leave motions free? In space alone
  dealii::DoFHandler<dim> dof_handler;
  dealii::IndexSet owned, relevant; ///< relevant: of neighbours and plates as well
  dealii::AffineConstraints<double> constraints;
  std::vector<PlateOnMesh<dim>> plates;          ///< all of the scene
  std::vector<ContactDofFace<dim>> faces;        ///< of this process, as the next
  std::unique_ptr<const OppositeFaces> opposite; ///< of #faces; null: no bodies touch each other
  std::vector<ContactDof<dim>> contact;          ///< what acts at its Gauss points
  std::optional<DistributedVector> past;         ///< of count_slip_from()
  dealii::types::global_dof_index n_free;        ///< of all processes, as all that follows
  dealii::types::global_dof_index n_discs;
  dealii::types::global_dof_index n_pressures;

  dealii::types::global_dof_index n_multipliers() const
  {
    return (dim - 1) * n_discs + n_pressures;
  }

private:
  void number();
  void find_contact();
  void find_opposite_faces();
  void take_moments_of_parts(unsigned int number);
  void add_contact_dofs(const ContactDofFace<dim> &face, typename ContactDof<dim>::Kind kind,
                        const std::vector<dealii::types::global_dof_index> &dofs);
  template <typename Value>
  Value mean(const ContactDofFace<dim> &face, unsigned int k,
             const std::function<Value(const dealii::Point<dim> &)> &f) const;
  double gap_at(const ContactDofFace<dim> &face, const dealii::Point<dim> &x) const;
  ContactDofFace<dim> face_of(const Cell &cell, unsigned int number) const;
  dealii::Vector<double> components_at(const BoxTables<dim> &tables,
                                       const std::vector<dealii::types::global_dof_index> &dofs,
                                       const std::vector<unsigned int> &shapes,
                                       const DistributedVector &u) const;
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> face_numbers; ///< by cell, face
  std::vector<bool> masters;         ///< by boundary; none: no bodies touch each other
  std::vector<bool> opposite_to_any; ///< likewise, see is_opposite()
  std::vector<bool> curved;          ///< by pair, see is_in_curved_pair()
};
} // namespace hpvi

#endif
