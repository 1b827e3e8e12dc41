// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_energies_h
#define hpvi_energies_h

#include <hpvi/discretisation/elastic_system.h>
#include <hpvi/discretisation/solution.h>

namespace hpvi
{
/** Energies of a discrete solution, unit stress length^dim. */
struct Energies
{
  double lagrangian = 0; ///< 1/2 a(u_N,u_N) - L(u_N) + b(u_N, lambda_N) - int lambda_Nn u_0
  double energy = 0;     ///< J(u_N) = 1/2 a(u_N,u_N) - L(u_N) + int g |u_Nt|
  double norm = 0;       ///< |u_N|_a = a(u_N,u_N)^{1/2}
  /**
   * energy - lagrangian = int (g |u_Nt| - g lambda_N u_Nt), >= 0 up to overshoot of lambda_N; the part of
   * unilateral contact, int lambda_Nn (u_0 - u_Nn), vanishes at every point of the multiplier.
   */
  double slack = 0;
};

/** The integral of g |u_Nt| cuts each edge where g jumps or u_Nt changes sign. */
template <int dim>
Energies energies(const Solution<dim> &solution, const ElasticSystem<dim> &system, double a);
} // namespace hpvi

#endif
