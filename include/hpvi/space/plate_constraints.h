// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_plate_constraints_h
#define hpvi_plate_constraints_h

#include <hpvi/base/processes.h>
#include <hpvi/plane/plates.h>
#include <hpvi/space/degree_tables.h>

#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_handler.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * A rigid plate on a distributed mesh. Its #masters, of any process, are unknowns; all other nodes on it follow them, by
 * constraints of the space.
 */
template <int dim>
struct PlateOnMesh
{
  dealii::types::boundary_id boundary;
  PlateMotion<dim> motion;
  PlateMasters<dim> masters; ///< of its free motions
  PlateMasters<dim> gauges;  ///< of all

  /** U and phi of nodal values that have those at the gauges, @p u. */
  std::array<double, PlateMotion<dim>::n_motions> amounts(const DistributedVector &u) const;
};

/** Nodes of #supported_nodes() on plates. */
template <int dim>
std::vector<SupportedNode<dim>> plate_nodes(const Scene<dim> &scene,
                                            const dealii::DoFHandler<dim> &dof_handler,
                                            const DegreeTables<dim> &tables);

/**
 * Adds the constraints of all plates to @p constraints, not closed, and masters and gauges to the unknowns @p relevant.
 * Collective. Throws as supported_nodes().
 */
template <int dim>
std::vector<PlateOnMesh<dim>>
constrain_plates(const Scene<dim> &scene, const dealii::DoFHandler<dim> &dof_handler,
                 const DegreeTables<dim> &tables, dealii::IndexSet &relevant,
                 dealii::AffineConstraints<double> &constraints);

/** `F . U + M . phi` of all @p plates, with the forces of @p scene, on nodal values @p u. */
template <int dim>
double plate_work(const Scene<dim> &scene, const std::vector<PlateOnMesh<dim>> &plates,
                  const DistributedVector &u);
} // namespace hpvi

#endif
