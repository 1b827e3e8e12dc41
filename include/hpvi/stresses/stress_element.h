// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stress_element_h
#define hpvi_stress_element_h

#include <deal.II/base/tensor.h>
#include <hpvi/scene/material.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * Polynomials in xi, eta on [-1,1]^2 by their Legendre coefficients c(i,j), i and j below n; those of a
 * stress are its components xx, yy, xy in the frame of the cell.
 */
template <unsigned int n_components>
struct Modes
{
  explicit Modes(const unsigned int n = 0) : n(n), coefficients(n_components * n * n)
  {
  }

  double &operator()(const unsigned int k, const unsigned int i, const unsigned int j)
  {
    return coefficients[(k * n + i) * n + j];
  }
  double operator()(const unsigned int k, const unsigned int i, const unsigned int j) const
  {
    return coefficients[(k * n + i) * n + j];
  }

  unsigned int n;
  std::vector<double> coefficients; ///< of one component after the other, j fastest
};

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
class StressElement
{
public:
  /**
   * @p degree is m >= 4, @p B has determinant 1, bit c of @p marked_corners marks corner c in deal.II's
   * order.
   */
  StressElement(unsigned int degree, const dealii::Tensor<2, 2> &B, const Material &material,
                unsigned int marked_corners);

  const unsigned int m;
  const unsigned int n_normal, n_tangential; ///< coefficients of a traction on an edge: m-1, m
  const unsigned int n_divergence, n_edges, n_data;

  /** Place of a coefficient of the traction of @p face among those of all edges. */
  unsigned int edge_entry(const unsigned int face, const unsigned int tangential) const
  {
    return face * (n_normal + n_tangential) + tangential * n_normal;
  }

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
  /** Calls f(row, entry) for the data of one mode of S. */
  template <class F>
  void for_each_datum(unsigned int component, unsigned int i, unsigned int j, const F &f) const;
  bool has(unsigned int component, unsigned int i, unsigned int j) const;

  void set_compliance(const dealii::Tensor<2, 2> &B, const Material &material);
  void set_tractions(const dealii::Tensor<2, 2> &B);
  void add_corner_stress(unsigned int corner);
  void set_conditions(const dealii::Tensor<2, 2> &B);
  void add_condition(const std::vector<double> &condition);
  void factorise();
  std::vector<double> corner_amplitudes(const Modes<3> &stress, const Modes<3> &q) const;
  Modes<3> nearest(const Modes<3> &stress, std::vector<double> &amplitudes) const;
  void subtract_data(const Modes<3> &q, double *r) const;
  Modes<3> inverse_compliance(const Modes<3> &moments) const;
  void set_nearest(unsigned int i, unsigned int j, const std::array<double, 3> &moments,
                   Modes<3> &result) const;
  Modes<3> moments(const Modes<3> &stress) const;

  /** The additional stress of a marked corner. */
  struct CornerStress
  {
    unsigned int corner;
    Modes<3> moments;         ///< of C^-1 of it with L_i L_j
    Modes<3> nearest;         ///< modes of its projection onto the tensor product space
    std::vector<double> data; ///< those of the corner stress
  };

  std::array<std::array<double, 3>, 3> compliance; ///< C^-1 between components
  /** Inverse of compliance for the components of a mode that exist, by their bits. */
  std::array<std::array<std::array<double, 3>, 3>, 8> inverses;
  /** Of edges along eta (0) and xi (1): T_n of the normal component, T_t of it and of the shear. */
  std::array<std::array<double, 3>, 2> traction;
  std::vector<CornerStress> corners;
  std::vector<double>
      corner_energy; ///< of corner stresses minus their projections, and its inverse
  std::vector<double> N, L, G_edges;
};
} // namespace hpvi

#endif
