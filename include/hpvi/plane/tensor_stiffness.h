// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_tensor_stiffness_h
#define hpvi_tensor_stiffness_h

#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/shape_tables.h>
#include <hpvi/scene/scene.h>

#include <array>
#include <map>
#include <vector>

namespace hpvi
{
/**
 * Stiffness matrices of cells in the plane whose map is not affine, by sum factorisation: shape functions are products
 * of polynomials in one coordinate, `phi_i = l_i1(xi) l_i2(eta)`, and so is each pair of derivatives,

     K_ij = sum_q2 sum_rs B_rs,i2 j2(q2) sum_q1 A_rs,i1 j1(q1) C_rs(q1, q2)

 * with A and B products of l and l' at Gauss points and C_rs, r and s directions of the reference cell, from the moduli
 * and the map. C_rs of two components is symmetric in r and s but for a part that the map does not change, so that pairs
 * i1 <= j1 are enough and one matrix product serves all components. What changes its sign when i2 and j2 are swapped is
 * summed apart from what does not: pairs i2 <= j2 are enough, too. `O(p^5)` operations, where shape functions at all
 * points would need `O(p^6)`.
 */
class TensorStiffness
{
public:
  /** @p tables must outlive this object. */
  explicit TensorStiffness(const ShapeTables<2> &tables);

  /**
   * K: the lower triangle by columns of the matrix of a cell of @p scene, n x n, unknowns inside the cell first, otherwise in
   * deal.II's order; what is above the diagonal keeps what it was. Without hoop strains. @p n_points along xi and eta.
   */
  void integrate(const Scene<2> &scene, const CellMap<2> &map, const HookesLaw<2> &law,
                 unsigned int degree, const std::array<unsigned int, 2> &n_points,
                 std::vector<double> &K);

  /** Of both of the above: pairs of components (0,0), (1,1), and (0,1) less its part that is skew in r and s. */
  static constexpr unsigned int n_blocks = 3;

private:
  /** Products of two polynomials i <= j at the Gauss points: n(n+1)/2 x 4 points, by which of both are derived. */
  struct Products
  {
    std::vector<double> along;  ///< both, none, sum and difference of the first and the second
    std::vector<double> across; ///< what belongs to these in the other direction
    const std::vector<dealii::Point<1>> &points;
    const std::vector<double> &weights;
  };

  /** Where pairs (i1 <= j1, i2 <= j2) of shape functions stand in K, as they are or with i2 and j2 swapped. */
  struct Half
  {
    /** Of components (0,0), (1,1), (0,1), and of those with i and j swapped. */
    std::array<std::vector<unsigned int>, 4> of;
    std::vector<double> rotations; ///< int d_0 phi_i d_1 phi_j - d_1 phi_i d_0 phi_j
  };
  struct Places
  {
    std::array<Half, 2> halves;
  };

  const Products &products(unsigned int degree, unsigned int n_points);
  const Places &places(unsigned int degree);
  void tabulate_coefficients(const Scene<2> &scene, const CellMap<2> &map, const HookesLaw<2> &law,
                             const Products &x, const Products &y);
  void sum_rotations(const Scene<2> &scene, const CellMap<2> &map, const Products &x,
                     const Products &y, unsigned int n_pairs);
  void scatter(unsigned int pair, unsigned int n_pairs, bool is_swapped, const Half &half,
               double turning, std::vector<double> &K) const;

  const ShapeTables<2> &tables;
  std::map<std::array<unsigned int, 2>, Products> known_products;
  std::map<unsigned int, Places> known_places;

  // Scratch, which keeps its memory from cell to cell.
  std::array<std::vector<double>, 3>
      coefficients; ///< C_rs of (0,0), (0,1), (1,1): points x (blocks x points)
  std::vector<double> sums, symmetric, skew;
  std::array<std::vector<double>, 2> rotations; ///< of an axisymmetric body; else empty
};
} // namespace hpvi

#endif
