// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_macro_triangle_h
#define hpvi_macro_triangle_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <hpvi/bound/triangle_stress.h>
#include <hpvi/scene/material.h>

#include <array>
#include <vector>

namespace hpvi
{
double cross(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b); ///< a_x b_y - a_y b_x

/** One triangle of a MacroStressElement: its energy, and its tractions from those on the edges of the cell. */
class MacroTriangle
{
public:
  /** With face @p f of a cell, whose diagonals cross at @p crossing, in units of @p h from its vertex 0. */
  MacroTriangle(const TriangleStress &triangle, unsigned int f,
                const std::array<dealii::Point<2>, 4> &vertices, const dealii::Point<2> &crossing,
                double h, const Material &material);

  dealii::Tensor<2, 2> B; ///< the Jacobian of its map is `scale B`, |det B| = 1
  double scale;
  std::array<unsigned int, 3> places;          ///< of its edges among all of the cell
  std::array<dealii::Tensor<2, 2>, 3> to_edge; ///< from tractions there to S nu
  std::vector<double> L, X; ///< of the bubbles, once eliminated: K = L L'; L^-1 Z'M R_e

  /** Energy of S nu on its edges: n_edges x n_edges, in columns of n_edges + n_bubbles. */
  std::vector<double> eliminate_bubbles();

  /** S := M S for columns of stresses. */
  void apply_energy(unsigned int columns, std::vector<double> &S) const;

  /** S nu on its edges from tractions on those of the cell; and back for a gradient, which is added. */
  std::vector<double> tractions(const std::vector<double> &t) const;
  void add_gradient(const double *from, double *gradient) const;

private:
  const TriangleStress &triangle;
  std::array<double, 6> energy; ///< of components: C^-1 h^2, by pairs as in TriangleStress
};
} // namespace hpvi

#endif
