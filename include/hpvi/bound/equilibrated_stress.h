// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_equilibrated_stress_h
#define hpvi_equilibrated_stress_h

#include <hpvi/bound/boundary_tractions.h>
#include <hpvi/bound/parallelogram_stresses.h>
#include <hpvi/bound/row_stresses.h>

#include <array>
#include <memory>
#include <vector>

namespace hpvi
{
/**
 * A stress s in equilibrium with the loads, `div s = -Pi F` and `s n = Pi G` where tractions are
 * given, with continuous tractions, and `s_t = -Pi (g lam*)` along the contact, and a given s_n <= 0 where that is unilateral: the sum over all
 * vertices a of stresses near psi_a sigma(u_N), each the solution of a small problem on the patch of a
 * (DOI 10.1090/S0025-5718-07-02080-7 for the idea). These can be solved because u_N meets the discrete
 * equations for psi_a times any rigid motion, which takes p >= 2. Where there are long cells, it is the solution of one problem for
 * all cells.
 */
class EquilibratedStress
{
public:
  using Parts = BoundaryTractions::Parts;

  /**
   * @p friction: l with `lam* = sum psi l`, psi the hat function that is 1 at the end; @p pressure: t with
   * `s_n = -sum t` on faces with unilateral contact, which are not asked for elsewhere. @p measured: the u_N from which
   * the distance is measured, and to which s is nearest inside cells; another one than that with which s is in balance.
   * @p volume: how the discrete equations of the latter count changes of volume. @p joints: tractions along all contacts instead.
   */
  EquilibratedStress(const Solution<2> &solution, const Parts &friction, const Parts &pressure,
                     EquilibrationCache &cache, const Solution<2> *measured = nullptr,
                     Volume volume = Volume::full, const JointTractions *joints = nullptr);

  std::vector<double>
      squares; ///< `|s - sigma(u_N)|^2` in energy, by active cell index, s the symmetric part of rows

  /** Likewise C_K |s_12 - s_21|, a part of the oscillation. */
  std::vector<double> antisymmetry;
  double defect =
      0; ///< largest violation of a condition N'r = 0, relative to tractions, or initial stresses where these are larger
  unsigned int worst_vertex = 0;    ///< of the patch with it
  bool is_worst_in_corners = false; ///< as PatchDefect tells it from equilibrium

  const VertexPatches &patches() const;

  /** Both components of the traction on each edge: Legendre coefficients, as in VertexPatches. */
  const std::vector<std::array<std::vector<double>, 2>> &tractions() const;

  /** What loads and contact prescribe on edges of the boundary. */
  const BoundaryTractions &prescribed() const;

  double missed_force(unsigned int cell) const; ///< |F - Pi F| on the cell

  /** As RowStresses has them. */
  std::vector<RowStresses::JointPart> joint_parts(unsigned int cell, unsigned int face) const;

  /** |tau - Pi tau| on a master's face in a joint. */
  double missed_traction(unsigned int cell, unsigned int face) const;

  /** What the initial stress has beyond the polynomials of s, in complementary energy; rows count it in `squares`. */
  double missed_initial_stress(unsigned int cell) const;

  /** initial_stress_error() of @p cell at the points of @p solution, looked at in the first step that has the cell. */
  double initial_stress_error(const Solution<2> &solution, unsigned int cell) const;

  const LegendreTables &legendre_tables() const;

  /** s on a cell of a mesh of parallelograms. */
  StressElement::Stress stress(unsigned int cell) const;

  /** B of the element of a cell: `s = B S B'`. */
  dealii::Tensor<2, 2> frame(unsigned int cell) const;

  /** Has the mesh cells that are no parallelograms, so that all have stresses by rows? */
  bool has_rows() const;

  /** s by rows on a cell at reference coordinates in [0,1]. */
  dealii::Tensor<2, 2> value_of_rows(unsigned int cell, const dealii::Point<2> &reference) const;

private:
  PatchCell patch_cell(unsigned int cell, unsigned int hat) const;
  void set_tractions(bool has_long_cells, double initial_stress);
  void solve_patches();
  void solve_all_cells();
  void add_tractions(unsigned int cell, double *target) const;
  std::vector<double> data_of(unsigned int cell) const;
  std::vector<double> row_tractions(unsigned int cell) const;
  void measure_from(const Solution<2> &other);
  void measure();

  EquilibrationCache &cache;
  const JointTractions *const joints;
  const VertexPatches vertex_patches;
  const BoundaryTractions boundary;
  std::unique_ptr<const RowStresses> row_stresses;
  std::unique_ptr<ParallelogramStresses> plain_stresses; ///< without rows
  std::vector<std::array<std::vector<double>, 2>> sums;  ///< tractions
};
} // namespace hpvi

#endif
