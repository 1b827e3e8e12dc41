// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_row_stresses_h
#define hpvi_row_stresses_h

#include <hpvi/bound/boundary_tractions.h>
#include <hpvi/bound/patch_problem.h>
#include <hpvi/bound/row_element.h>

#include <string>
#include <vector>

namespace hpvi
{
/** Stresses by rows near sigma(u_N) and near its products with hat functions, on cells of any shape. */
class RowStresses
{
public:
  /** @p cache must outlive this object, and its elements must stay as long as this is asked for stresses. */
  RowStresses(const Solution<2> &solution, const VertexPatches &patches,
              const BoundaryTractions &boundary, EquilibrationCache &cache);

  /** Data of `psi sigma` with divergence `sigma grad psi - psi F`. */
  PatchCell patch_cell(unsigned int cell, unsigned int hat) const;

  struct Distance
  {
    double square;       ///< |sym s - sigma(u_N)|^2 in energy
    double antisymmetry; ///< C_K |s_12 - s_21|, part of the oscillation
  };

  /** For tractions on the faces in the order of TractionEnergy. */
  Distance distance(unsigned int cell, const std::vector<double> &tractions) const;

  /** s, by rows, at reference coordinates in [0,1]. */
  dealii::Tensor<2, 2> value(unsigned int cell, const std::vector<double> &tractions,
                             const dealii::Point<2> &reference) const;

  double missed_force(unsigned int cell) const; ///< |F - Pi F| on the cell

private:
  struct Cell
  {
    const RowElement *element;
    double h;                       ///< of the element [length]
    std::vector<double> divergence; ///< (k+1)^2 of each row, of -F
    double missed_force = 0;
    std::vector<double> gradients, defects; ///< by hat
  };

  /** Of the four bilinear psi of a cell. */
  struct OfVertices
  {
    std::array<std::vector<double>, 4> divergence; ///< (k+1)^2 of each row
    std::array<double, 4> moment{}; ///< that Lemma 4 of doc/bound.md adds [stress length^2]
  };

  RowShape shape_of(unsigned int cell) const;
  void set_cell(unsigned int cell);
  void add_stress(unsigned int cell, OfVertices &result) const;
  void add_loads(unsigned int cell, OfVertices &result);
  std::vector<dealii::SymmetricTensor<2, 2>> sigma(unsigned int cell,
                                                   const ShapeTable<2> &table) const;
  void set_missed_force(unsigned int cell);
  std::vector<dealii::SymmetricTensor<2, 2>> stress_at_points(unsigned int cell) const;
  RowValues::Stress residual(unsigned int cell, const std::vector<double> &tractions,
                             RowFields &fields) const;

  const Solution<2> &solution;
  const VertexPatches &patches;
  const BoundaryTractions &boundary;
  EquilibrationCache &cache;
  std::vector<Cell> cells;
};

/** Where an initial strain is cut inside a cell, in words; else empty. These stresses know none of its pieces. */
std::string cut_inside_cell(const Solution<2> &solution);
} // namespace hpvi

#endif
