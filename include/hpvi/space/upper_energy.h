// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_upper_energy_h
#define hpvi_upper_energy_h

#include <hpvi/results/energies.h>
#include <hpvi/space/primal_space.h>

namespace hpvi
{
/** Of the largest displacement: what interpolation of a polynomial misses. */
constexpr double round_off_of_supports = 1e-13;

/** By how much @p u misses what supports prescribe between their nodes at most [length]. Collective. */
template <int dim>
double missed_displacement(const PrimalSpace<dim> &space, const DistributedVector &u);

/**
 * An upper end of the least J: `J(u_N)` where u_N is admissible, with the loads integrated by twice as many points and
 * raised by what both rules differ by. NaN where a law minimises no energy, where u_N may penetrate a foundation,
 * where it misses prescribed displacements between their nodes, or where loads differ by more than 1e-3 of their work. @p energies and
 * @p work = L(u_N) are those of the path. Collective.
 */
template <int dim>
double upper_energy(const PrimalSpace<dim> &space, const DistributedVector &u,
                    const Energies &energies, double work);
} // namespace hpvi

#endif
