// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_displacement_lift_h
#define hpvi_displacement_lift_h

#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/shape_tables.h>
#include <hpvi/scene/scene.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * |d|_a^2 on one cell [stress length^2] for a displacement d that is @p delta on a face and zero on all others, the least
 * over some. delta vanishes at both ends of the face: Legendre coefficients of its components, all of one size.
 *
 * With s along the face and n in [0,1] across the cell, d = delta(s) (1 - n)^q; or, on a parallelogram, with components
 * along the edges d = d_s a_s + d_n a_n, and likewise delta,
 *
 *     d_s = F a'(n) + delta_s b(n),  d_n = -F' a(n) + m B b(n),  a = (1 - n)^q (1 + q n),  b = (1 - n)^r,
 *     B = 6 s (1 - s),  m = int delta_n,  -F' = delta_n - m B,
 *
 * which changes the volume by `delta_s' b + m B b'` only: with r large and m small next to nothing.
 */
double lift_energy(const CellMap<2> &map, unsigned int face,
                   const std::array<dealii::Vector<double>, 2> &delta, const Material &material,
                   const ShapeTables<2> &tables);

/** A displacement at a point of a quadrature rule along an edge. */
struct EdgePoint
{
  double s, weight;                  ///< in [0,1]; the sum of weights is 1
  dealii::Tensor<1, 2> value, slope; ///< slope by s
};

/** Of a polynomial by its Legendre coefficients, as many points as those and @p more. */
std::vector<EdgePoint> edge_points(const std::array<dealii::Vector<double>, 2> &delta,
                                   unsigned int more, const ShapeTables<2> &tables);

/** The same with `delta(s) (1 - n)^q` alone, for pieces of polynomials which the points integrate. */
double lift_energy(const CellMap<2> &map, unsigned int face, const std::vector<EdgePoint> &delta,
                   const Material &material, const ShapeTables<2> &tables);

/** int k delta . delta over an edge, of springs if it has any [stress length^2]. */
double spring_energy(const Scene<2> &scene, const BoundaryCondition<2> &condition,
                     const CellMap<2> &map, unsigned int face, const std::vector<EdgePoint> &delta);
} // namespace hpvi

#endif
