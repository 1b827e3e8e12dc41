// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_strain_points_h
#define hpvi_strain_points_h

#include <hpvi/body/shape_tables.h>
#include <hpvi/scene/scene.h>

#include <array>

namespace hpvi
{
/** A cell, the same in all meshes with its coarse cells, and a number: the key of what steps share of it. */
using CellKey = std::array<unsigned int, 5>;
CellKey cell_key(const dealii::Triangulation<2>::cell_iterator &cell, unsigned int number);

/**
 * Gauss points per direction for integrals with the initial strain eps_0 in a cell: as many, at least p + 3, as give its moments
 * with polynomials of degree 2 to round-off. Then the discrete equations are those of the polynomial through its values at
 * these points, which equilibrated stresses count on.
 */
unsigned int strain_points(const Scene<2> &scene,
                           const dealii::Triangulation<2>::cell_iterator &cell, unsigned int degree,
                           const ShapeTables<2> &tables);
} // namespace hpvi

#endif
