// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_limits_h
#define hpvi_limits_h

#include <hpvi/driver/stop.h>
#include <hpvi/plane/iterative_refinement.h>
#include <hpvi/results/energies.h>
#include <hpvi/results/warnings/history.h>

#include <deal.II/base/types.h>

#include <functional>

namespace hpvi
{
/** What limits ask of the solution of the last step, numbers of all processes. */
struct LastSolution
{
  dealii::types::global_dof_index n_free; ///< unknowns
  double
      displacement; ///< the largest of u_N's components at a node, and of the data's scale [length]
  double missed;    ///< what u_N misses of the data in the energy norm
  /** round_off_of_estimate(); asked only where the indicator is small, on all processes at once. */
  std::function<double()> round_off;
  bool is_bound_open = false; ///< what the step lacks of it may still be computed
  /** Backend::resolves_data(); asked only where an error is small, on all processes at once. */
  std::function<bool()> resolves_data = []() { return true; };
};

/**
 * Throws NumericalFailure where double precision ends: energies that overflow or underflow, where
 * @p displacement is the largest of u_N.
 */
template <int dim>
void check_numbers(const Scene<dim> &scene, double displacement, const Energies &energies);

/** Likewise where round-off has spoilt a displacement, also beside the load steps before, of which @p negligible is negligible_energy(). */
void check_algebraic_error(const AlgebraicError &error, double negligible);

/**
 * Why the last step of @p history needs no next one; Stop::round_off where the indicator is that of the last bits of u_N, and so is
 * LastSolution::missed. No error is small enough while the discrete problem does not see all data.
 */
template <int dim>
Stop reached_limit(const Scene<dim> &scene, const History<dim> &history, const LastSolution &last);
} // namespace hpvi

#endif
