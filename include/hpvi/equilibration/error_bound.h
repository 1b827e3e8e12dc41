// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_error_bound_h
#define hpvi_error_bound_h

#include <hpvi/discretisation/discretisation.h>
#include <hpvi/equilibration/equilibrated_stress.h>

#include <vector>

namespace hpvi
{
/**
 * A guaranteed bound of the error of u_N against the solution u of the variational inequality. With a
 * stress s in equilibrium and friction -g lam*, |lam*| <= 1, along the contact,
 *
 *     |u - u_N|_a <= O + (eta^2 + 2 gap(u_N - w) + (|w|_a + |d|_a + O)^2)^{1/2},
 *     eta = |s - sigma(u_N)| in energy,   gap(v) = int g (|v_t| - lam* v_t),
 *
 * w from SlipCorrection, O and d from DataError; without the last two `eta^2 + 2 gap + |w|_a^2`. If u_N meets
 * prescribed displacements, its energy is above the least one by at most
 *
 *     J(u_N) - J(u) <= eta^2/2 + gap(u_N)
 *
 * and what oscillation adds. doc/bound.md proves both.
 */
struct ErrorBound
{
  double total = 0;       ///< of |u - u_N|_a, (stress length^dim)^{1/2}
  double stress = 0;      ///< eta
  double slip = 0;        ///< (2 gap(u_N - w) + |w|_a^2)^{1/2}
  double oscillation = 0; ///< O
  double data = 0;        ///< |d|_a
  double energy = 0;      ///< of J(u_N) - J(u) [stress length^dim]

  /** By active cell: eta_K^2 and what oscillation and slip add; to mark by. */
  std::vector<double> squares;

  std::vector<double> indicators() const; ///< roots of squares

  /** Largest imbalance of a patch, relative to its tractions: what round-off leaves of equilibrium. */
  double imbalance = 0;
};

/** Computes the bound step by step, with what it keeps between steps. */
class ErrorBounds
{
public:
  /** Scene::no_error_bound() must be empty. */
  ErrorBound compute(const Solution<2> &solution, const Discretisation<2> &discretisation);

private:
  EquilibrationCache cache;
};
} // namespace hpvi

#endif
