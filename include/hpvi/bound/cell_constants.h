// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cell_constants_h
#define hpvi_cell_constants_h

#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/material.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

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

  /** Else beta is 0 and nothing is known; of a cell on the axis slices of the solid are meant. */
  bool is_star_shaped(const Material &material) const;

  double poincare() const; ///< `|v|_K <= C |grad v|_K` for v of mean zero [length]

  double korn() const; ///< 2^{1/2}/beta

  /** `|v|_E <= C |grad v|_K` for v of mean zero [length^{1/2}]. */
  double trace(unsigned int face) const;

  /**
   * C with `|int_K q omega(v)| <= C |q|_K |v|_{a,K}`, omega = (d_1 v_2 - d_2 v_1)/2, for q of mean zero: `((1/beta^2 - 1/2)/c)^{1/2}`, c that
   * of coercivity(). In a body of revolution and a cell that touches the axis `(int q^2/w)^{1/2}` is in the place of |q|_K, for any q:
   * C^2 = (2 pi/W) sup (1/beta^2 - 1/2)/c, the supremum over slices of the solid up to a share kappa of its radius from the axis,
   * `W = pi - 2 phi + sin 2 phi`, kappa = cos phi. doc/bound.md has the proofs.
   */
  double antisymmetry(const Material &material) const;

  bool is_on_axis(const Material &material) const; ///< of a body of revolution, at some vertex

  /**
   * In a cell with an edge on the axis `int_E t . v <= C (int_E t^2/w)^{1/2} |eps(v)|`, strains with the weight w and around the axis, too, for
   * t whose component along the axis is orthogonal to constants. Infinite: nothing is known.
   */
  double trace_on_axis(unsigned int face) const;

  /** c with `c |eps(v)|_K^2 <= |v|_{a,K}^2`; in a body of revolution 2 pi times the least radius are in it. */
  double coercivity(const Material &material) const;

private:
  double distance(const dealii::Point<2> &x, unsigned int face) const;
  double largest_radius() const;
  double poincare_on_axis(unsigned int face_on_axis) const;
  double on_axis() const;
  using Piece = std::array<std::pair<double, double>, 5>;
  std::vector<Piece> pieces(unsigned int face_on_axis) const;
  double inner_of_slices(const std::vector<Piece> &all, double most) const;
  void look_at(unsigned int face);

  const CellMap<2> map;
  const dealii::Point<2> centre;
  double diameter = 0, outer = 0, least_x;
  std::array<double, 4> inner; ///< by face: no more than (x - c) . n along it [length]
};

/** That along x = 0, if there is one. */
std::optional<unsigned int> axis_face(const CellMap<2> &map);
} // namespace hpvi

#endif
