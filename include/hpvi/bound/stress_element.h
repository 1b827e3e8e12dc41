// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stress_element_h
#define hpvi_stress_element_h

#include <hpvi/bound/stress_space.h>

#include <array>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * Symmetric stresses with continuous tractions on one class of parallelograms (Hu, Man, Zhang,
 * arXiv:1304.5428). With edge vectors `2 h B`, det B = 1, h^2 a quarter of the area, a stress is
 * `s = B S B'` with
 *
 *     S_xx in Q_{m,m-2},  S_yy in Q_{m-2,m},  S_xy in Q_{m-1,m-1},
 *
 * so that `h div s = B Div S` with Div S in Q_{m-1,m-2} x Q_{m-2,m-1}, and the traction on an edge has
 * a normal part in P_{m-2} and a tangential part in P_{m-1}.
 *
 * Its data `r = (Div S; traction of left, right, bottom, top)` determine S up to (m-3)^2 Airy bubbles.
 * Tractions are `s n` with n in the direction of growing xi or eta on both of two opposite edges. Data
 * belong to a stress if they meet conditions `N' r = 0`: three of equilibrium, and one at each corner,
 * where both edges prescribe the same shear. Marked corners are free of theirs: an additional stress,
 * from the Airy function `r^2 F(theta) c(xi) c(eta)` with r and theta from that corner,
 * `F = -theta - sin(2 theta)/2 - (pi/4) cos(2 theta) + pi/4`, has shear 2 at the corner on the horizontal
 * edge and none on the vertical one.
 */
class StressElement : public StressSpace
{
public:
  /**
   * @p degree is m >= 4, @p B has determinant 1, bit c of @p marked_corners marks corner c in deal.II's
   * order.
   */
  StressElement(unsigned int degree, const dealii::Tensor<2, 2> &B, const Material &material,
                unsigned int marked_corners);

  /**
   * r := (@p divergence; 0) - A q, where q of the space is nearest to @p stress in energy and A q are
   * its data. Modes of degree above m - 1 (divergence) do not count.
   */
  void residual(const Modes<3> &stress, const Modes<2> &divergence, double *r) const;

  unsigned int n_conditions() const;
  const std::vector<double> &conditions() const; ///< N, columns of n_data with length 1

  /**
   * Columns n_divergence and following of G, where `min (s, C^-1 s) = h^2 r'G r` over the stresses s
   * with data r: n_data x n_edges.
   */
  const std::vector<double> &edge_energy() const;

  /** R := L^-1 R for columns of data, `|L^-1 r|^2 = r'G r`. */
  void half_energy(std::vector<double> &R, unsigned int columns) const;

  /** A stress of the space, at points. */
  class Stress
  {
  public:
    /** s in the frame of the cell (xx, yy, xy) at reference coordinates in [-1,1]. */
    std::array<double, 3> value(double xi, double eta) const;
    Modes<3> modes;
    std::vector<std::pair<unsigned int, double>> corners; ///< corner and amplitude
    unsigned int m;
  };

  /** q of residual() plus the least-energy stress with data @p r. */
  Stress stress(const Modes<3> &stress, const double *r) const;

private:
  void add_corner_stress(unsigned int corner);
  void set_conditions(const dealii::Tensor<2, 2> &B);
  void add_condition(const std::vector<double> &condition);
  void factorise();
  std::vector<double> corner_amplitudes(const Modes<3> &stress) const;

  /** The additional stress of a marked corner. */
  struct CornerStress
  {
    unsigned int corner;
    Modes<3> moments;         ///< of C^-1 of it with L_i L_j
    Modes<3> nearest;         ///< modes of its projection onto the tensor product space
    std::vector<double> data; ///< those of the corner stress
  };

  std::vector<CornerStress> corners;
  std::vector<double>
      corner_energy; ///< of corner stresses minus their projections, and its inverse
  std::vector<double> N, L, G_edges;
};
} // namespace hpvi

#endif
