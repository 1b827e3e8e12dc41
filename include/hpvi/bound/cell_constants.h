// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cell_constants_h
#define hpvi_cell_constants_h

#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/material.h>

#include <array>

namespace hpvi
{
/**
 * Constants of inequalities on a cell K, guaranteed. With rho, R the radii of an inner and an outer circle about its centre c, K
 * star-shaped with respect to the inner one,
 *
 *     |grad v| <= 2^{1/2}/beta |eps(v)|   for some rotation of v,     beta^2 >= x^2/(2 (1 + (1 - x^2)^{1/2})),   x = rho/R
 *
 * (Horgan and Payne; proof by Costabel and Dauge, arXiv:1303.6141). Convex cells with straight edges have d/pi for that of Poincare (Payne and
 * Weinberger, 10.1007/BF00252910), d their diameter, curved ones `(2/pi) (max det F max |F|^2/det F)^{1/2}` of the map F from [-1,1]^2.
 * Edges follow from div(t b v^2), t from 0 on the edge opposite to E to 1 on E, b along the other edges of a parallelogram, or from
 * `div((x - P) v^2)`, P the middle of the opposite edge, c where edges are curved.
 */
class CellConstants
{
public:
  explicit CellConstants(const CellMap<2> &map);

  bool is_star_shaped() const; ///< else beta is 0 and nothing is known

  double poincare() const; ///< `|v|_K <= C |grad v|_K` for v of mean zero [length]

  double korn() const; ///< 2^{1/2}/beta

  /** `|v|_E <= C |grad v|_K` for v of mean zero [length^{1/2}]. */
  double trace(unsigned int face) const;

  /**
   * C with `|int_K q omega(v)| <= C |q|_K |v|_{a,K}`, omega = (d_1 v_2 - d_2 v_1)/2, for q of mean zero: `((1/beta^2 - 1/2)/c)^{1/2}`, c the
   * coercivity of the material. doc/bound.md has the proof.
   */
  double antisymmetry(const Material &material) const;

private:
  double distance(const dealii::Point<2> &x, unsigned int face) const;
  void look_at(unsigned int face);

  const CellMap<2> map;
  const dealii::Point<2> centre;
  double diameter = 0, outer = 0;
  std::array<double, 4> inner; ///< by face: no more than (x - c) . n along it [length]
};
} // namespace hpvi

#endif
