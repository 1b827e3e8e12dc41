// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_triangle_stress_h
#define hpvi_triangle_stress_h

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <map>
#include <vector>

namespace hpvi
{
/**
 * Symmetric stresses S in P_k on the triangle (1,0), (0,1), (0,0), by coefficients in the orthonormal basis
 *
 *     phi_l = c P_i(2v - 1) u^i P_j^{(0,2i+1)}(2u - 1),   x = u (1 - v), y = u v,   i + j <= k,
 *
 * ordered by i + j: first all of xx, then of yy, then of xy. Their data are Div S, in P_{k-1}, and `S nu` on
 * the edges (1,0)-(0,1), (0,0)-(1,0), (0,0)-(0,1), with nu the outer normal times the length of the edge:
 * coefficients of x, then of y, in Legendre polynomials along the edge that are orthonormal on [-1,1]. A
 * triangle of any shape has the same matrices: `s = B S B'` with its Jacobian h B, |det B| = 1.
 *
 * Data belong to a stress if they meet six conditions `N'r = 0`: three of equilibrium, and at each vertex
 * `nu_f . (S nu_e) = nu_e . (S nu_f)`. The stress is unique up to (k-2)(k-3)/2 Airy bubbles.
 */
struct TriangleStress
{
  explicit TriangleStress(unsigned int degree); ///< k >= 1

  /** phi_l at u, v. */
  static std::vector<double> basis(unsigned int degree, double u, double v);

  const unsigned int k;
  const unsigned int n;            ///< coefficients of each component
  const unsigned int n_divergence; ///< k (k + 1)
  const unsigned int n_edges;      ///< 6 (k + 1)
  const unsigned int n_bubbles;

  /** 3n x n_divergence: the stresses of least norm with the given divergence and no tractions. */
  std::vector<double> of_divergence;

  /**
   * 3n x (n_edges + n_bubbles): those of least norm with the given tractions and no divergence; the bubbles,
   * orthonormal. For data that do not meet the conditions, as near as can be.
   */
  std::vector<double> of_edges;

  /** Of each pair of components xx xx, yy yy, xy xy, xx yy, xx xy, yy xy: `A'B + B'A` (A'A) of their rows of of_edges. */
  std::array<std::vector<double>, 6> products;

  /** Columns of n_divergence + n_edges: translations, rotation about (0,0), the three vertices. */
  std::vector<double> conditions;

private:
  std::vector<double> data_matrix() const;
  void set_conditions();
  void add_vertex_conditions();
  std::vector<double> orthonormal_conditions() const;
  void set_stresses();
  void add_bubbles(const std::vector<double> &A, const std::vector<double> &R);
  void set_products();
};

/** Values of the basis at the points of a Gauss rule for triangles. */
struct TriangleTable
{
  /** @p n_gauss points in u and in v. */
  TriangleTable(unsigned int degree, unsigned int n_gauss);

  std::vector<std::array<double, 2>> points; ///< x, y
  std::vector<double> weights;               ///< their sum is 1/2
  std::vector<double> values;                ///< phi_l, n x n_points
};

/** Triangles by degree, tables by degree and points, each computed when first asked for. */
class TriangleStresses
{
public:
  const TriangleStress &triangle(unsigned int degree) const;
  const TriangleTable &table(unsigned int degree, unsigned int n_gauss) const;

private:
  mutable std::map<unsigned int, TriangleStress> triangles;
  mutable std::map<std::array<unsigned int, 2>, TriangleTable> tables;
};
} // namespace hpvi

#endif
