// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_corner_stress_h
#define hpvi_corner_stress_h

#include <deal.II/base/quadrature.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * The additional stress of a marked corner of a StressElement of degree @p m at xi, eta in [-1,1]: xx, yy, xy in the
 * frame of the cell. Its divergence is zero, its tractions are polynomials of degree 4, or 2 where m < 5, and vanish along the two edges
 * away from the corner.
 */
std::array<double, 3> corner_stress(unsigned int m, unsigned int corner, double xi, double eta);

/** For integrals with such stresses over the unit square: Duffy's, collapsed into the corner, of 2 n^2 points; for several corners in each quarter. */
dealii::Quadrature<2> corner_quadrature(const std::vector<unsigned int> &corners,
                                        unsigned int n_gauss);
} // namespace hpvi

#endif
