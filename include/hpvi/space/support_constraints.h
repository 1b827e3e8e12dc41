// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_support_constraints_h
#define hpvi_support_constraints_h

#include <hpvi/plane/supports.h>
#include <hpvi/scene/scene.h>
#include <hpvi/space/degree_tables.h>

#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <vector>

namespace hpvi
{
/**
 * The nodes of cells of this process and beside it on boundaries with prescribed displacements, u_n = 0 or a rigid plate,
 * by their first unknown, each with the conditions of all boundaries that meet there. Throws InputError where an expression
 * of the scene is not finite.
 */
template <int dim>
std::vector<SupportedNode<dim>> supported_nodes(const Scene<dim> &scene,
                                                const dealii::DoFHandler<dim> &dof_handler,
                                                const DegreeTables<dim> &tables);

/**
 * What holds nodes: hanging ones those of their neighbours, then supports in any direction; plates see constrain_plates().
 * @p constraints are those of the unknowns @p relevant, not closed. Throws as supported_nodes().
 */
template <int dim>
void constrain_supports(const Scene<dim> &scene, const dealii::DoFHandler<dim> &dof_handler,
                        const DegreeTables<dim> &tables, const dealii::IndexSet &relevant,
                        dealii::AffineConstraints<double> &constraints);
} // namespace hpvi

#endif
