// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_energy_rule_h
#define hpvi_energy_rule_h

#include <hpvi/plane/cell_map.h>

namespace hpvi
{
unsigned int map_degree(const CellMap<2> &map); ///< in each reference coordinate

/** Degrees of polynomials on the reference cell, the larger of both directions. */
struct EnergyDegrees
{
  unsigned int stress;    ///< of `det DF s`, of a body of revolution of `w det DF s`
  bool has_circumference; ///< is w = 2 pi x among what the energy is divided by?
};

/** Of `det DF sigma` of a displacement of degree @p p. */
EnergyDegrees degrees_of_square(const CellMap<2> &map, unsigned int p, bool is_axisymmetric);

/**
 * A rule of Gauss for energies `int P/D` of a cell, P a square of polynomials, D = det DF or x det DF. With a polynomial r of degree m and
 * `|1 - r D| <= delta` on the cell
 *
 *     (1 - delta) int P/D <= int P r = sum w P r <= (1 + delta) sum w P/D,
 *
 * where the rule is exact for P r. So `factor = (1 + delta)/(1 - delta)` times what the rule says is an upper bound. r interpolates 1/D at points of
 * Gauss, and delta is the sum of all Legendre coefficients of 1 - r D, a polynomial. On the axis D is divided by what vanishes there, as P is.
 */
struct EnergyRule
{
  /** With at least so many points; more until the factor is 1 + @p enough or a dozen more do not lead there. */
  EnergyRule(const CellMap<2> &map, const EnergyDegrees &degrees, unsigned int n_gauss,
             double enough = 1e-6);

  /**
   * Of int (sigma, eps) of two displacements of these degrees, what the rule may miss over the product of both norms, 2 delta/(1 - delta):
   * |P (1 - r D)/D| is integrated and summed, each at most delta times the product of both roots, of int and of sum.
   */
  double missed() const
  {
    return factor - 1;
  }

  unsigned int n_gauss;  ///< in each direction
  unsigned int n_corner; ///< of corner_quadrature(), for squares with corner_stress() among them
  double factor;         ///< infinite where delta is 1 or more
};
} // namespace hpvi

#endif
