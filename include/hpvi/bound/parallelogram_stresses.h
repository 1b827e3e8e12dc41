// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_parallelogram_stresses_h
#define hpvi_parallelogram_stresses_h

#include <hpvi/bound/legendre.h>
#include <hpvi/bound/modes.h>
#include <hpvi/bound/patch_data.h>
#include <hpvi/bound/patch_problem.h>
#include <hpvi/plane/element_matrices.h>
#include <hpvi/plane/solution.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace hpvi
{
/** An initial stress C eps_0 in a parallelogram. */
struct InitialModes
{
  Modes<3> modes;
  double missed =
      0; ///< norm in complementary energy of what they lack of the polynomial on the cell
};

/**
 * What RowStresses has for cells of any shape, for cells that are all parallelograms: the stresses near sigma(u_N) and near
 * its products with hat functions, which are polynomials here.
 */
class ParallelogramStresses
{
public:
  /**
   * @p marked_corners as BoundaryTractions has them; @p volume: how the discrete equations count changes of volume.
   * @p cache must outlive this object, and its elements must stay as long as this is asked for stresses.
   */
  ParallelogramStresses(const Solution<2> &solution, const VertexPatches &patches,
                        const std::vector<unsigned int> &marked_corners, Volume volume,
                        EquilibrationCache &cache);

  /** Data of `psi sigma` with divergence `sigma grad psi - psi F`. */
  PatchCell patch_cell(unsigned int cell, unsigned int hat) const;

  /** From now on sigma is that of another u_N, for all but patch_cell(). */
  void measure_from(const Solution<2> &other);

  /** Data of sigma with divergence -F, which tractions are added to. */
  std::vector<double> data(unsigned int cell) const;

  /** |s - sigma|^2 in energy of all cells, from data of each with its tractions. */
  using WithTractions = std::function<std::vector<double>(unsigned int cell)>;
  std::vector<double> squares(const WithTractions &with_tractions);

  /** s for such data. */
  StressElement::Stress stress(unsigned int cell, const std::vector<double> &data) const;

  /** B of the element of a cell: `s = B S B'`. */
  dealii::Tensor<2, 2> frame(unsigned int cell) const;

  double missed_force(unsigned int cell) const; ///< |F - Pi F| on the cell

  /** The norm in complementary energy of what sigma lacks of C eps_0 on the cell, where a scene has initial strains. */
  double missed_initial_stress(const unsigned int cell) const
  {
    return cells[cell].initial.missed;
  }

private:
  struct Batch;

  /** One cell: its element, its loads in its frame, and where its columns of data are. */
  struct Cell
  {
    const StressElement *element;
    dealii::Tensor<2, 2> B;
    double h;             ///< of the element [length]
    InitialModes initial; ///< of C eps_0; without modes: none
    Modes<2> force;       ///< -F in the frame, from the points of the loads; without modes: none
    Batch *batch;
    unsigned int place, first_hat; ///< in its batch
  };

  /** All data of the cells of one element with displacements, and forces, of one degree. */
  struct Batch
  {
    std::vector<unsigned int> cells;
    unsigned int n_hats = 0;
    const PatchData *of_modes = nullptr; ///< of each mode, if there are cells enough
    // Not set before each thread sets its own part: to touch all of it takes as long as to compute it.
    std::unique_ptr<double[]> r;                  ///< for psi = 1, by cell
    std::unique_ptr<double[]> gradients, defects; ///< G r and N' r by hat function
  };

  /** Some cells of one batch, one after the other. */
  struct Part
  {
    Batch *batch;
    std::vector<unsigned int> some_cells;
  };

  std::vector<Part> parts();
  void set_cells(const std::vector<unsigned int> &marked_corners);
  CellLaw law(unsigned int cell) const;
  Modes<3> displacement_stress(unsigned int cell) const;
  Modes<3> seen(unsigned int cell, Modes<3> sigma) const;
  CellStress cell_stress(unsigned int cell) const;
  std::vector<double> modes(const Part &part) const;
  void set_data_of_modes();
  void set_data();
  void set_part(const Part &part);
  void set_hats(const Part &part, const std::vector<double> &sides);
  void set_own_data(const Part &part);

  const Solution<2> &solution;
  const Solution<2> *measured; ///< sigma is that of its u_N
  const VertexPatches &patches;
  bool is_projected; ///< does it know but the projection of div u_N?
  EquilibrationCache &cache;
  std::vector<Cell> cells;
  /** By element, p and number of modes of the force. */
  std::map<std::pair<const StressElement *, std::array<unsigned int, 2>>, Batch> batches;
};
} // namespace hpvi

#endif
