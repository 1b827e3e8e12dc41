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
/** A vector along a contact face, its components those of tangents(). */
template <int dim>
using Tangential = dealii::Tensor<1, dim - 1>;

/** `|m| G`: friction at one Gauss point of a contact face, where `|lambda| <= 1`. */
template <int dim>
struct ContactDisc
{
  dealii::Point<dim> x;
  double bound;                               ///< g(x) [stress]
  double radius;                              ///< G = g(x) int psi_k [force]
  std::array<unsigned int, dim - 1> unknowns; ///< of its moments among those of this process
};

/** A face with friction, the discs of its Gauss points one after the other from #first on. */
template <int dim>
struct FrictionFace
{
  typename dealii::DoFHandler<dim>::active_cell_iterator cell;
  unsigned int face;
  unsigned int first;
};

/**
 * The displacements of one degree on a distributed mesh of boxes, in the basis in which contact is
 * diagonal: on faces with friction moments stand for the inner nodal values of tangential components
 * (see BoxTables). Moments belong to one cell, never hang and are never prescribed.
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

  Tangential<dim> moment(const DistributedVector &v, unsigned int disc) const; ///< of v at a disc
  void add_moment(DistributedVector &v, unsigned int disc, const Tangential<dim> &value) const;

  /** u on @p cell, of this process or beside it. */
  CellField<dim> field(const Cell &cell, const DistributedVector &u) const;

  /** Lengths of the edges of @p cell. */
  static dealii::Tensor<1, dim>
  extent(const typename dealii::Triangulation<dim>::cell_iterator &cell);

  /** Where the point @p unit of the unit cell lies in @p cell. */
  static dealii::Point<dim> point_of(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                                     const dealii::Point<dim> &unit);

  const BoundaryCondition<dim> &condition(const Cell &cell, unsigned int face) const;

  /** Of @p cell: which faces have friction? */
  std::vector<bool> friction_faces(const Cell &cell) const;

  /** The first disc of a face with friction of this process. */
  unsigned int first_disc(const Cell &cell, unsigned int face) const;

  const Scene<dim> &scene;
  const BoxTables<dim> &tables;
  dealii::DoFHandler<dim> dof_handler;
  dealii::IndexSet owned, relevant;
  dealii::AffineConstraints<double> constraints;
  std::vector<FrictionFace<dim>> faces; ///< of this process, as all that follows
  std::vector<ContactDisc<dim>> discs;
  dealii::types::global_dof_index n_free;  ///< of all processes
  dealii::types::global_dof_index n_discs; ///< likewise

private:
  void number();
  void constrain();
  void find_discs();
  dealii::types::global_dof_index dof(const std::vector<dealii::types::global_dof_index> &dofs,
                                      unsigned int shape, unsigned int component) const;

  std::map<std::pair<unsigned int, unsigned int>, unsigned int> first_discs; ///< by cell, face
};
} // namespace hpvi

#endif
