// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_limits_h
#define hpvi_limits_h

#include <hpvi/adaptivity/history.h>
#include <hpvi/discretisation/iterative_refinement.h>
#include <hpvi/discretisation/solution.h>
#include <hpvi/evaluation/energies.h>

#include <string>

namespace hpvi
{
/**
 * Throws NumericalFailure where double precision ends: energies that overflow or underflow, a
 * displacement that round-off has spoilt.
 */
template <int dim>
void check_numbers(const Solution<dim> &solution, const Energies &energies,
                   const AlgebraicError &algebraic);

/**
 * Why @p solution, that of the last step of @p history, needs no next one: an entry of section
 * Adaptivity, or "round-off" where the indicator is that of the last bits of u_N, and so is @p missed, what
 * u_N misses of the data in the energy norm. Empty: it does.
 */
template <int dim>
std::string reached_limit(const Solution<dim> &solution, const History &history, double missed);
} // namespace hpvi

#endif
