// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_data_error_h
#define hpvi_data_error_h

#include <hpvi/bound/equilibrated_stress.h>
#include <hpvi/bound/joint_lift.h>

#include <vector>

namespace hpvi
{
/**
 * What an equilibrated stress and u_N miss of the data of a scene, in energy.
 *
 * Loads: s is in equilibrium with projections Pi F, Pi G that have the same force and moment on each cell
 * and edge. So on a convex cell K of diameter d, with z the rigid motion nearest to e,
 *
 *     int_K (F - Pi F).e <= d/pi |F - Pi F|_K |grad(e - z)|_K,
 *     int_E (G - Pi G).e <= ((d^2/pi^2 + 2 b d/pi)/H)^{1/2} |G - Pi G|_E |grad(e - z)|_K
 *
 * by Payne and Weinberger (10.1007/BF00252910) and by the trace inequality that integrates
 * div(t b v^2), t from 0 on the edge opposite to E to 1 on E, b along the other edges, H the height over E;
 * and where K is no parallelogram, with the triangle of E and the middle P of the opposite edge, H the
 * distance of P from E and l that of its farther end, by div((x - P) v^2)
 *
 *     |v|_E^2 <= 2 (d^2/pi^2 + l d/pi)/H |grad v|_K^2   for v of mean zero;
 *
 * `|grad(e - z)|_K <= 2^{1/2}/(beta c^{1/2}) |e|_{a,K}` with the coercivity c of the material and
 * `beta >= rho/(2^{1/2} R) (1 + (1 - rho^2/R^2)^{1/2})^{-1/2}` for radii rho, R of an inner and an outer
 * circle about the centre (Horgan and Payne; proof by Costabel and Dauge, arXiv:1303.6141).
 *
 * Prescribed displacements u_D outside V_N: d = u_D - u_N on the edge, lifted into its cell by lift_energy(); likewise what the
 * interpolation I at the nodes of V_N misses of a gap, `u_0 - I u_0` along the normal. Both are read at the Gauss-Lobatto points of a
 * polynomial of degree p + 12 on each edge. By how much they differ from it in between is counted as an oscillation of the next degrees: that
 * is an estimate, and small.
 */
class DataError
{
public:
  /** @p joints: a part of d, null: there is none. */
  DataError(const Solution<2> &solution, const EquilibratedStress &stress,
            const JointLift *joints = nullptr);

  std::vector<double> oscillation; ///< of loads, by active cell index: to be added to |s - sigma|_K
  std::vector<double> lifts;       ///< |d|_K with the springs of its edges, by active cell index
  double unresolved; ///< what quadrature leaves open of all loads: to be added to the oscillation
  /** The oscillation of what contact, friction and springs exert, and unresolved: what tractions of s miss of forces; see ErrorBound::radius. */
  double beside = 0;
  double lift = 0;        ///< |d|_a
  double lift_work = 0;   ///< int (s n - G + k u_N) . d over the boundary [stress length^dim]
  double missed_work = 0; ///< what that may miss, because of
  double missed_data =
      0; ///< how far u_D and u_0 are from these polynomials between their nodes [length]
  dealii::Point<2> missed_at;

private:
  void add_initial_strain(const Solution<2> &solution, const EquilibratedStress &stress);
};
} // namespace hpvi

#endif
