// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_equilibrated_stress_h
#define hpvi_equilibrated_stress_h

#include <hpvi/equilibration/macro_stresses.h>

#include <functional>
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
  /** Legendre coefficients of a polynomial on a contact face, that of one of its ends. */
  using Parts = std::function<std::vector<double>(unsigned int face, unsigned int end)>;

  /**
   * @p friction: l with `lam* = sum psi l`, psi the hat function that is 1 at the end; @p pressure: t with
   * `s_n = -sum t` on faces with unilateral contact, which are not asked for elsewhere. @p measured: the u_N from which
   * the distance is measured, and to which s is nearest inside cells; another one than that with which s is in balance.
   * @p volume: how the discrete equations of the latter count changes of volume.
   */
  EquilibratedStress(const Solution<2> &solution, const Parts &friction, const Parts &pressure,
                     EquilibrationCache &cache, const Solution<2> *measured = nullptr,
                     Volume volume = Volume::full);

  std::vector<double> squares; ///< `|s - sigma(u_N)|^2` in energy, by active cell index
  double defect = 0; ///< largest violation of a condition N'r = 0, relative to the tractions
  unsigned int worst_vertex = 0;    ///< of the patch with it
  bool is_worst_in_corners = false; ///< as PatchDefect tells it from equilibrium

  const VertexPatches &patches() const;

  /** Both components of the traction on each edge: Legendre coefficients, as in VertexPatches. */
  const std::vector<std::array<std::vector<double>, 2>> &tractions() const;

  /** What loads and friction prescribe at s in [0,1] of an edge of the boundary. */
  dealii::Tensor<1, 2> prescribed_traction(unsigned int edge, double s) const;

  /** Points and weights on [0,1] for integrals with it. */
  std::vector<std::pair<double, double>> prescribed_points(unsigned int edge) const;

  double missed_force(unsigned int cell) const; ///< |F - Pi F| on the cell

  const LegendreTables &legendre_tables() const;

  /** s on a cell of a mesh of parallelograms. */
  StressElement::Stress stress(unsigned int cell) const;

  /** B of the element of a cell: `s = B S B'`. */
  dealii::Tensor<2, 2> frame(unsigned int cell) const;

  /** Has the mesh cells that are no parallelograms, so that all are macro cells? */
  bool has_macro_cells() const;

  /** s on a macro cell at reference coordinates in [0,1]. */
  dealii::Tensor<2, 2> macro_value(unsigned int cell, const dealii::Point<2> &reference) const;

private:
  /** One cell: its element, the stress of u_N in its frame, and where its columns of data are. */
  struct Cell
  {
    const StressElement *element;
    dealii::Tensor<2, 2> B;
    double h; ///< of the element [length]
    Modes<3> sigma;
    Modes<2> force; ///< -F in the frame, from the points of the loads; without modes: none
    unsigned int place, first_hat; ///< in its batch
  };

  /** What the contact prescribes, by end of a face; without pressure: none. */
  struct ContactParts
  {
    std::array<std::vector<double>, 2> friction, pressure;
  };

  /** The four bilinear functions 1, xi, eta, xi eta, of which a hat function is a combination. */
  static constexpr unsigned int n_bilinear = 4;

  /** All data of the cells of one element. */
  struct Batch
  {
    std::vector<unsigned int> cells;
    unsigned int n_hats = 0;
    std::vector<double> r;                  ///< for psi = 1, by cell
    std::vector<double> gradients, defects; ///< G r and N' r by hat function
  };

  /** S_xy of a cell at one end of a boundary edge. */
  struct EndShear
  {
    double known = 0, scale = 0; ///< what is prescribed of it, and of tractions
    bool is_free = false;        ///< the tangential traction is unknown
    bool leans = false;          ///< an unknown component has a weight in it
  };

  LoadRule<1> load_rule(const StressEdge &edge) const;
  dealii::Tensor<1, 2> load_on(const StressEdge &edge, double s) const;
  dealii::Tensor<1, 2> friction_on(const StressEdge &edge, unsigned int end, double s,
                                   double bound) const;
  void set_known_tractions(unsigned int edge);
  void add_load(unsigned int edge, unsigned int end, double s, double weight,
                const dealii::Tensor<1, 2> &traction);
  void meet_ends(const StressEdge &edge, unsigned int end, const dealii::Tensor<1, 2> &at_end);
  std::vector<unsigned int> marked_corners() const;
  EndShear end_shear(unsigned int edge, unsigned int end) const;
  void set_cells();
  void set_data();
  void set_stress(unsigned int cell, const Solution<2> &of);
  void set_own_data(unsigned int cell);
  void set_force(unsigned int cell);
  void set_force(unsigned int cell, const dealii::Quadrature<2> &rule);
  void set_data(unsigned int cell, double *r) const;
  void add_to_hats(const std::vector<unsigned int> &some_cells, const std::vector<double> &matrix,
                   const std::vector<double> &r, std::vector<double> &result) const;
  void set_tractions();
  void solve_patches();
  void solve_all_cells();
  PatchCell patch_cell(unsigned int cell, unsigned int hat) const;
  void add_tractions(unsigned int cell, const TractionEnergy &element, double *target) const;
  std::vector<double> data_of(unsigned int cell) const;
  std::vector<double> macro_tractions(unsigned int cell) const;
  void measure_from(const Solution<2> &other);
  void measure();

  const Solution<2> &solution;
  std::vector<ContactParts> contact_parts; ///< by contact face
  EquilibrationCache &cache;
  const Volume volume;
  const VertexPatches vertex_patches;
  std::unique_ptr<const MacroStresses> macro_stresses; ///< or what follows, up to batches
  std::vector<Cell> cells;
  std::map<const StressElement *, Batch> batches;
  /** psi times what is prescribed, by edge, end and component. */
  std::vector<std::array<std::array<std::vector<double>, 2>, 2>> known;
  std::vector<std::array<std::vector<double>, 2>> sums; ///< tractions
};
} // namespace hpvi

#endif
