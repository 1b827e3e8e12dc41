// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_stress_h
#define hpvi_box_stress_h

#include <hpvi/bound/legendre.h>
#include <hpvi/scene/material.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * Stresses on a box of volume one in space whose rows are vector fields of Raviart and Thomas of degree k = p + 1, not symmetric: those that
 * are nearest to sigma(u), u of degree p, and to its products with hat functions psi, for given data. Data are, row by row, (k+1)^3
 * Legendre coefficients of the divergence, then (k+1)^2 of the outward traction on each face, its coordinates in rising
 * order. They belong to a stress whose antisymmetric parts have the mean zero if six conditions hold, balance of force
 * and moment. Sums of modes have the first axis fastest. Of a box of the same shape with volume l^3 the divergence is to be multiplied
 * by l and u divided by it; then tractions and stresses are the same, and energies l^3 times as large.
 */
class BoxStress
{
public:
  using Matrix = dealii::LAPACKFullMatrix<double>;

  /** Of displacements of degree @p p, on a box whose edges have the ratios of @p shape. Throws NumericalFailure where round-off spoils it. */
  BoxStress(unsigned int p, const dealii::Tensor<1, 3> &shape, const Material &material);

  const unsigned int p, n;         ///< n = k + 1 modes in each direction
  const dealii::Tensor<1, 3> size; ///< of the volume one

  unsigned int n_row() const ///< data of a row
  {
    return n * n * n + 6 * n * n;
  }

  /** The first datum of @p face in row @p component. */
  unsigned int on_face(const unsigned int face, const unsigned int component) const
  {
    return component * n_row() + n * n * n + face * n * n;
  }

  static constexpr unsigned int n_conditions = 6;

  /** Coefficient of L_i in (1 -+ x)/2 L_j. */
  static double hat_product(bool right, unsigned int i, unsigned int j);

  /**
   * By data, then conditions: from (p+1)^3 modes of each component of u the gradient of the energy and the defect of the
   * conditions for the stress nearest to psi sigma(u), psi trilinear with @p hat at the corners, and the divergence sigma(u) grad psi.
   */
  void add_hat(const std::array<double, 8> &hat, const dealii::Vector<double> &u,
               std::vector<double> &result) const;

  /** What data add to that. */
  void add_data(const std::vector<double> &data, std::vector<double> &result) const;

  /** Second derivatives of the energy, by data. */
  double second(unsigned int i, unsigned int j) const
  {
    return G(i, j);
  }

  double condition(unsigned int datum, unsigned int i) const
  {
    return N(datum, i);
  }

  struct Distance
  {
    double square;       ///< |sym s - sigma(u)|^2 in energy
    double antisymmetry; ///< C |q|: its part of the oscillation
  };

  /** Of the best s with these data. */
  Distance distance(const std::vector<double> &data, const dealii::Vector<double> &u) const;

  /** Modes of component (i, j) of sigma(u), (p+1)^3 of them. */
  std::vector<double> stress(const dealii::Vector<double> &u, unsigned int i, unsigned int j) const;

  /** C with `|v - z| <= C l |v|_a` over a box of volume l^3 for a rigid motion z [stress^{-1/2}]. */
  double poincare() const;

  /** C with `|v - z| <= C l^{1/2} |v|_a` over a face for the z of poincare() [stress^{-1/2}]. */
  double trace(unsigned int face) const;

private:
  unsigned int n_component() const ///< modes of a component of a row
  {
    return n * n * (n + 1);
  }
  unsigned int place(unsigned int i, unsigned int j, const std::array<unsigned int, 3> &mode) const;
  void set_law();
  void set_rows();
  void set_energy();
  void set_stresses();
  void set_hats();
  Matrix weighted(const Matrix &fields, bool symmetric_alone) const;
  Matrix times_hat(unsigned int v) const;
  Matrix divergence_of_hat(unsigned int v) const;

  const HookesLaw<3> law;
  double c, C; ///< coercivity; of the antisymmetric part, C/c^{1/2}
  std::array<std::array<double, 9>, 9> symmetric,
      both;    ///< energy of modes, with what antisymmetry costs
  Matrix R, Z; ///< of one row: a field for data, fields without any
  Matrix lift; ///< best fields for data
  Matrix G, N;
  Matrix sigma;             ///< of modes of u, as a field
  Matrix own;               ///< what the best field has of it beside data
  std::vector<Matrix> hats; ///< by corner, for add_hat()
};
} // namespace hpvi

#endif
