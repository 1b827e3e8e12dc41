// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_interpolation_h
#define hpvi_interpolation_h

#include <hpvi/plane/solution.h>

namespace hpvi
{
/**
 * u_N of @p coarse as a displacement of @p finer, whose mesh descends from that of @p coarse and whose
 * degrees are nowhere lower: the same field. All unknowns, constrained ones included [length].
 */
template <int dim>
dealii::Vector<double> interpolate(const Solution<dim> &coarse,
                                   const DisplacementSpace<dim> &finer);

/** @p coarse, its multiplier too, as a state of the mesh of @p finer: of its own scene still, and there no solution. */
template <int dim>
Solution<dim> interpolate(const Solution<dim> &coarse, const Spaces<dim> &finer);
} // namespace hpvi

#endif
