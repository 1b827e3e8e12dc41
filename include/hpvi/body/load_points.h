// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_load_points_h
#define hpvi_load_points_h

#include <hpvi/body/cell_map.h>
#include <hpvi/body/shape_tables.h>
#include <hpvi/scene/scene.h>

namespace hpvi
{
/**
 * Gauss points per direction for a load, at least p + 2: as many as give its moments with polynomials
 * of degree 2 to round-off. Then the discrete equations hold with the exact load for every hat function
 * times a rigid motion, which equilibrated stresses build on. A load that jumps inside an edge never gets
 * there and takes 64.
 */
template <int dim>
unsigned int traction_points(const BoundaryCondition<dim> &condition, const CellMap<dim> &map,
                             unsigned int face, unsigned int degree,
                             const ShapeTables<dim> &tables);

/** The same for the body force of a cell. */
template <int dim>
unsigned int body_force_points(const Scene<dim> &scene, const CellMap<dim> &map,
                               unsigned int degree, const ShapeTables<dim> &tables);
} // namespace hpvi

#endif
