// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_macro_stresses_h
#define hpvi_macro_stresses_h

#include <hpvi/bound/macro_stress_element.h>
#include <hpvi/bound/patch_problem.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * The stresses of macro cells near sigma(u_N) and near its products with hat functions, on any convex
 * quadrilaterals. sigma(u_N) is no polynomial there: what it has outside the space is measured by itself, so
 * that nothing cancels.
 */
class MacroStresses
{
public:
  /** @p cache must outlive this object, and its elements must stay as long as this is asked for stresses. */
  MacroStresses(const Solution<2> &solution, const VertexPatches &patches,
                EquilibrationCache &cache);

  /** Data of `psi sigma` with divergence `sigma grad psi - psi F`. */
  PatchCell patch_cell(unsigned int cell, unsigned int hat) const;

  /** |s - sigma(u_N)|^2 in energy for tractions on the faces in the order of the element. */
  double square(unsigned int cell, const std::vector<double> &tractions) const;

  /** s at reference coordinates xi, eta in [0,1]. */
  dealii::Tensor<2, 2> value(unsigned int cell, const std::vector<double> &tractions,
                             const dealii::Point<2> &reference) const;

  double missed_force(unsigned int cell) const; ///< |F - Pi F| on the cell

private:
  struct Cell
  {
    const MacroStressElement *element;
    double h;                      ///< of the element [length]
    MacroStressElement::Data data; ///< of sigma(u_N) and -F
    double remainder = 0;          ///< |sigma - q|^2, q its projection
    double missed_force = 0;
    std::vector<double> gradients, defects; ///< by hat
  };

  void set_cell(unsigned int cell);
  void set_hats(unsigned int cell, const MacroStressElement::Data &by_vertex);

  const Solution<2> &solution;
  const VertexPatches &patches;
  EquilibrationCache &cache;
  std::vector<Cell> cells;
};

/** Where a body force or initial strain is cut inside a cell, in words; else empty. These stresses know none of its pieces. */
std::string cut_inside_distorted_cell(const Solution<2> &solution);
} // namespace hpvi

#endif
