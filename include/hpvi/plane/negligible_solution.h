// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_negligible_solution_h
#define hpvi_negligible_solution_h

#include <hpvi/plane/discretisation.h>

namespace hpvi
{
/**
 * What a(u_N,u_N) is as good as zero beside the load steps before, `1e-24 stress displacement size^(dim-1)` of Scene::past_data: a
 * body with no more is moved, not strained. 0 without load steps before.
 */
template <int dim>
double negligible_energy(const Scene<dim> &scene);

/**
 * What is round-off beside the data of the scene and its history is zero: multipliers @p z, then displacements @p u, where
 * a(u,u) is @p energy. True: both are zero now.
 */
template <int dim>
bool drop_round_off(const Discretisation<dim> &discretisation, double energy,
                    dealii::Vector<double> &z, dealii::Vector<double> &u);
} // namespace hpvi

#endif
