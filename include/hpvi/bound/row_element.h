// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_row_element_h
#define hpvi_row_element_h

#include <hpvi/bound/traction_energy.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/material.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * The Raviart-Thomas fields of degree k on [-1,1]^2, Q_{k+1,k} x Q_{k,k+1}, by what they are made of: k^2 bubbles
 * `curl N_a(xi) N_b(eta)`, N_a the integral of L_a from -1; for each face and i <= k the field with flux L_i there, towards growing
 * xi or eta, and no divergence but its mean; and (k+1)^2 with divergence L_i(xi) L_j(eta) and no flux, none for that which is
 * constant: fluxes and divergence that are in balance have it from the fluxes. Behind them, for each marked corner, both rows of its corner_stress(). At
 * n x n Gauss points, xi fastest, or with corners at those of corner_quadrature().
 */
struct RowTable
{
  /** Bit c of @p marked_corners marks corner c. */
  RowTable(unsigned int degree, unsigned int n_gauss, unsigned int marked_corners);

  unsigned int n_fields() const
  {
    return of_corner(corners.size());
  }
  unsigned int of_face(const unsigned int face) const
  {
    return k * k + face * (k + 1);
  }
  unsigned int of_divergence() const
  {
    return k * k + 4 * (k + 1);
  }

  unsigned int of_corner(const unsigned int number) const
  {
    return of_divergence() + (k + 1) * (k + 1) + 2 * number;
  }

  /** xi and eta component of all fields at reference coordinates in [0,1]. */
  std::array<std::vector<double>, 2> at(const dealii::Point<2> &reference) const;

  const unsigned int k, n_gauss;
  std::vector<unsigned int> corners;         ///< marked
  std::vector<dealii::Point<2>> points;      ///< in [0,1]^2
  std::vector<double> weights;               ///< their sum is 4
  std::array<std::vector<double>, 2> fields; ///< xi and eta component, n_fields x points
};

/** What a cell is to its rows of stress, besides its material: all in units of h. */
struct RowShape
{
  dealii::types::material_id material;
  const Material *law;
  CellMap<2> map; ///< [length]
  double h;       ///< h^2 is a quarter of the area of the corners' quadrilateral [length]
  std::array<double, 4>
      densities; ///< by face: flux on [-1,1] over the traction that StressEdge counts [length]
  double antisymmetry; ///< C_K of CellConstants
};

class RowValues;

/**
 * Stresses s on a cell of any shape whose rows are fields of a RowTable by the contravariant map, `s_i = DF r_i/det DF`:
 *
 *     det DF div s_i = Div r_i,     (s n)_i ds = (r_i nu) dt,
 *
 * so that divergence and tractions are polynomials on the reference cell whatever F is (doc/bound.md). s need not be symmetric:
 * energies are those of its symmetric part, and `theta C_K^2 |s_12 - s_21|^2` beside them. Data belong to such a stress whose
 * antisymmetric part has mean zero if forces and moment are in balance: three conditions `N'r = 0`.
 */
class RowElement
{
public:
  /** @p table must outlive this object. */
  RowElement(const RowTable &table, const RowShape &shape);

  static constexpr unsigned int n_conditions = 3;
  static constexpr double theta = 16;

  const RowTable &table;

  TractionEnergy energy() const;

  /** Moments `(d, z)` of divergences, (k+1)^2 of each row, with the motions of N: what N' r takes off. */
  std::array<double, 3> moments(const double *divergence) const;

  /** Fields whose change makes an energy least that has these @p derivatives by all fields: 2 n_fields. */
  std::vector<double> best_bubbles(const std::vector<double> &derivatives) const;

  /** Of derivatives by all fields, 2 n_fields: those by tractions with the best bubbles, n_edges. */
  std::vector<double> reduced(const std::vector<double> &derivatives) const;

private:
  void set_conditions(const RowShape &shape);
  unsigned int n_bubbles() const
  {
    return 2 * table.k * table.k + table.corners.size();
  }
  std::vector<double> by_bubbles(const std::vector<double> &derivatives) const;
  void add_corners(const RowShape &shape, const RowValues &values, std::vector<double> &columns);
  unsigned int n_edges() const
  {
    return 8 * (table.k + 1);
  }

  const std::array<double, 4> scale; ///< densities over h
  std::vector<double> L, W, G,
      N; ///< of bubbles; L^-1 times bubbles x edges; edges x edges; edges x 3
  std::vector<double> N_divergence; ///< 2 (k+1)^2 x 3

  /** Of each marked corner B S, S its stress and B = DF there, less what has its fluxes: by fields, 2 n_fields. */
  std::vector<std::vector<double>> corners;
};

/** One cell at the points of its table: fields in energy, `(s, C^-1 s)^{1/2}` by its parts and `theta^{1/2} C_K (s_12 - s_21)`. */
class RowValues
{
public:
  RowValues(const RowTable &table, const RowShape &shape);

  static constexpr unsigned int n_parts = 4; ///< the last is the antisymmetric one

  /** Coefficients of all fields, row by row, in energy: n_parts x points are added to @p values. */
  void add(const std::vector<double> &coefficients, std::vector<double> &values) const;

  /** The transposed. */
  std::vector<double> derivatives(const std::vector<double> &values) const;

  /** Subtracts `psi sigma` in energy at one point. */
  void subtract(unsigned int q, const dealii::SymmetricTensor<2, 2> &sigma, double psi,
                std::vector<double> &values) const;

  /** The bubbles of the table, row by row: (n_parts points) x columns. */
  std::vector<double> bubbles() const;

  /** All edges in the order of TractionEnergy, likewise. */
  std::vector<double> edges(const std::array<double, 4> &scale) const;

  const RowTable &table;

private:
  void append(unsigned int row, unsigned int first, unsigned int count, double factor,
              std::vector<double> &columns) const;

  /** [part][xi or eta component] of one row at one point. */
  using Frame = std::array<std::array<double, 2>, n_parts>;

  std::array<std::vector<Frame>, 2> frames;        ///< by row and point
  std::array<std::array<double, 3>, 3> compliance; ///< L of C^-1 in xx, yy, xy
  std::vector<double> roots;                       ///< of weights times det DF/h^2
};
} // namespace hpvi

#endif
