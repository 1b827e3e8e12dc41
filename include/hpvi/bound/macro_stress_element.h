// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_macro_stress_element_h
#define hpvi_macro_stress_element_h

#include <hpvi/bound/macro_triangle.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * Symmetric stresses with continuous tractions on one convex quadrilateral: in P_k on each of the four
 * triangles that its diagonals cut (Johnson and Mercier, 10.1007/BF01403910, for k = 1). Triangle f has face
 * f, from a to b as deal.II numbers them, and the crossing c of the diagonals: its map takes (1,0) to a, (0,1)
 * to b, (0,0) to c.
 *
 * Lengths are in units of h, h^2 a quarter of the area: congruent cells share an element. The data are `h div s` in P_{k-1} on each triangle and
 * the traction on each face, in the direction of growing xi or eta: normal and tangential part in P_k.
 * They belong to a stress if force and moments are in balance, and to nothing else: three conditions `N'r = 0`.
 *
 * The energy |s - q|^2 of a given stress q of the triangles is minimised for each triangle over its Airy
 * bubbles, and then over the tractions between triangles.
 */
class MacroStressElement
{
public:
  using Vertices = std::array<dealii::Point<2>, 4>; ///< in deal.II's order

  /** @p triangle must outlive this object. */
  MacroStressElement(const TriangleStress &triangle, const Vertices &vertices,
                     const Material &material);

  static double size(const Vertices &vertices); ///< h

  const TriangleStress &triangle;
  const dealii::Point<2> crossing; ///< of the diagonals, from vertex 0, in units of h
  const unsigned int n_edges;      ///< coefficients of all faces

  const MacroTriangle &piece(unsigned int f) const;

  /** Stresses q and divergences `h div s`, in the frames of the triangles: `S = B^-1 s B^-T`, `Div S`. */
  struct Data
  {
    explicit Data(unsigned int columns = 0) : columns(columns)
    {
    }

    unsigned int columns;
    std::array<std::vector<double>, 4> stress;     ///< 3 triangle.n x columns
    std::array<std::vector<double>, 4> divergence; ///< triangle.n_divergence x columns
  };

  /** The part of the faces of N and of G, where `min |s - q|^2 = h^2 (t'G t + 2 g't) + const`, n_edges x n_edges. */
  const std::vector<double> &conditions() const;
  const std::vector<double> &edge_energy() const;
  static constexpr unsigned int n_conditions = 3;

  /** g (n_edges x columns) and N'r (3 x columns) where tractions vanish. */
  void reduce(const Data &data, std::vector<double> &gradients, std::vector<double> &defects) const;

  struct Stress
  {
    std::array<std::vector<double>, 4> coefficients; ///< of S in each triangle
    double energy;                                   ///< |s - q|^2/h^2
  };

  /** The nearest to q of one column, for tractions that meet the conditions. */
  Stress stress(const Data &data, const std::vector<double> &tractions) const;

  /** s at a point of the cell, given from vertex 0 in units of h. */
  dealii::Tensor<2, 2> value(const Stress &stress, const dealii::Point<2> &x) const;

private:
  /** Of columns of data: stresses without tractions minus q, and what they add to bubbles and edges. */
  struct Reduced
  {
    std::array<std::vector<double>, 4> rest, bubbles;
    std::vector<double> gradient, defect; ///< of all edges; of the conditions of the triangles
  };

  void add_energy(MacroTriangle &piece, std::vector<double> &H) const;
  void add_conditions(unsigned int f, std::vector<double> &C) const;
  void set_conditions();
  void normalise_conditions();
  void eliminate(const std::vector<double> &H, const std::vector<double> &C);
  Reduced reduce(const Data &data) const;
  std::vector<double> all_tractions(const Reduced &reduced, const std::vector<double> &t) const;

  std::vector<MacroTriangle> triangles; ///< four
  std::vector<double> N, N_divergence;  ///< n_edges x 3; of each triangle n_divergence x 3
  std::vector<double> G, L, W, Y, S, Q;
};
} // namespace hpvi

#endif
