// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stress_singularity_h
#define hpvi_stress_singularity_h

#include <hpvi/results/stress_extrema.h>

#include <vector>

namespace hpvi
{
/** A peak that grows with each step like a power of the size of cells, so that its value means nothing. */
template <int dim>
struct StressSingularity
{
  StressSample<dim> peak;   ///< of the last step
  dealii::Point<dim> where; ///< the vertex of the mesh next to it
  double within;            ///< two of its edges: the last cells [length]
  double force;   ///< of the contact edges that lie there as a whole [stress length^(dim-1)]
  double beyond;  ///< reach(): what is farther from this and all other such peaks is away
  double largest; ///< there [stress]; 0 where there is nothing
  dealii::Point<dim> largest_point;
};

/**
 * The peaks of the last of @p steps that have grown by more than 15 % in each of three steps and stayed
 * within two edges of where they were, the largest first; @p steps holds those of each step.
 */
template <int dim>
std::vector<StressSample<dim>>
growing_extrema(const std::vector<std::vector<StressSample<dim>>> &steps);

/**
 * Those of @p extrema towards which the stress grows in the same way on the one mesh of @p field: by more than 15 % in each of three steps
 * from ring to ring, with the radii h, 2 h, 4 h, 8 h about the vertex next to it, h the length of its edge. Collective.
 */
template <int dim>
std::vector<StressSample<dim>> extrema_of_rings(const std::vector<StressSample<dim>> &extrema,
                                                const std::vector<StressSample<dim>> &samples,
                                                const Field<dim> &field);

/** What there is to say of @p extrema, of which stress_samples() of @p field are @p samples. Collective. */
template <int dim>
std::vector<StressSingularity<dim>>
stress_singularities(const std::vector<StressSample<dim>> &extrema,
                     const std::vector<StressSample<dim>> &samples, const Field<dim> &field);
} // namespace hpvi

#endif
