// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_support_constraints_h
#define hpvi_support_constraints_h

#include <hpvi/scene/scene.h>

#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

namespace hpvi
{
/**
 * What holds nodes: hanging ones those of their neighbours, then prescribed displacements and, on faces whose normal is along an
 * axis, u_n = 0. @p constraints are those of the unknowns @p relevant, not closed. Throws InputError where an expression of the
 * scene is not finite.
 */
template <int dim>
void constrain_supports(const Scene<dim> &scene, const dealii::DoFHandler<dim> &dof_handler,
                        const dealii::IndexSet &relevant,
                        dealii::AffineConstraints<double> &constraints);

/** The axis that u_n = 0 holds on a face of a cell. */
template <int dim>
unsigned int held_axis(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                       unsigned int face);
} // namespace hpvi

#endif
