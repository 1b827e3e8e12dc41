// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_h
#define hpvi_mesh_h

#include <deal.II/grid/tria.h>
#include <hpvi/scene.h>

#include <vector>

namespace hpvi
{
/** The polynomial degree of each active cell, by active cell index. */
using Degrees = std::vector<unsigned int>;

/**
 * Build the coarse triangulation of @p scene: a regular grid of quadrilaterals whose boundary ids
 * are those of Scene::boundaries, bisected towards the points that the scene names. Throws
 * InputError where a cell would not be convex.
 */
template <int dim>
void make_mesh(const Scene<dim> &scene, dealii::Triangulation<dim> &triangulation);

/**
 * Bisect the cells that carry a refinement flag (with deal.II's 2:1 closure) and hand every child
 * the degree of its parent; @p degrees are the new degrees of the cells before bisection.
 */
template <int dim>
Degrees refine_mesh(dealii::Triangulation<dim> &triangulation, const Degrees &degrees);
} // namespace hpvi

#endif
