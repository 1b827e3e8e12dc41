// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_patch_data_h
#define hpvi_patch_data_h

#include <hpvi/bound/legendre.h>
#include <hpvi/bound/stress_element.h>

#include <vector>

namespace hpvi
{
/** Of one cell in its frame: sigma and -F; of either none, without modes. */
struct CellStress
{
  Modes<3> sigma;
  Modes<2> force;
};

/**
 * What patches need of cells of one element. With the data r of `psi sigma` with divergence `sigma grad psi - psi F`,
 * columns are, cell by cell, r for psi = 1, and G r on the edges with N' r below it for each of the bilinear functions
 * psi = 1, xi, eta, xi eta.
 */
struct PatchData
{
  static constexpr unsigned int n_bilinear = 4;

  std::vector<double> r;     ///< n_data x cells
  std::vector<double> sides; ///< (n_edges + n_conditions) x (4 cells)
};

/** r for psi = 1. */
void residual_of_one(const StressElement &element, const CellStress &cell, double *r);

PatchData patch_data(const StressElement &element, const std::vector<CellStress> &cells);

/** Modes of sigma(u) for u in Q_p, all up to p in both variables but the highest, and of -F with @p n_force in each. */
constexpr unsigned int n_modes(const unsigned int p, const unsigned int n_force)
{
  return 3 * ((p + 1) * (p + 1) - 1) + 2 * n_force * n_force;
}

/** Those modes in their order, appended. */
void append_modes(const CellStress &cell, unsigned int p, std::vector<double> &modes);

/**
 * PatchData is linear in these modes: that of each of them, which take the place of cells. For a cell it is a product with its modes.
 * Coefficients of u would be less, but of u much may be rigid motion, and what all data have in common of sigma is what balances them.
 */
PatchData data_of_modes(const StressElement &element, unsigned int p, unsigned int n_force);

/** What sigma(u) of a cell depends on besides u. */
struct CellLaw
{
  unsigned int degree;      ///< p
  dealii::Tensor<2, 2> B;   ///< of the element
  double h;                 ///< of the element [length]
  const Material *material; ///< of the cell
};

/** `sigma(u) = B S B'` in the frame of a cell, with room for n modes, from the @p coefficients of u as Solution has them. */
Modes<3> stress_modes(const CellLaw &cell, const std::vector<double> &coefficients, unsigned int n,
                      const LegendreTables &legendre);
} // namespace hpvi

#endif
