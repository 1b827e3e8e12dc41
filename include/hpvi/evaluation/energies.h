// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_energies_h
#define hpvi_energies_h

#include <hpvi/discretisation/elastic_system.h>
#include <hpvi/discretisation/solution.h>

namespace hpvi
{
/**
 * Energies of a discrete solution, unit stress length^dim. In a load history u_Nt is counted from the
 * load step before: these are the energies of the incremental problem.
 */
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

/** What happens while a load step goes from one displacement to the next by du [stress length^dim]. */
struct Work
{
  /**
   * `L(du) + R(du) - int lambda_Nn du_n - a(du,du)/2`: of loads, of prescribed displacements through
   * their reactions R and of the foundation's normal traction, all at the end of the load step; without
   * the energy that they would have left over had they acted so from its beginning.
   */
  double external = 0;
  double dissipated = 0; ///< int z_N du_t, of friction
};

/**
 * Of the load step from @p last, a displacement of the same space, to @p solution. `external` is formed
 * from forces, not from stresses at free nodes: that it is `dissipated` and the change of
 * `a(u_N,u_N)/2` together says that the solution is in equilibrium.
 */
template <int dim>
Work work(const Solution<dim> &solution, const ElasticSystem<dim> &system,
          const dealii::Vector<double> &last);

/** The integral of g |u_Nt| cuts each edge where g jumps or u_Nt changes sign. */
template <int dim>
Energies energies(const Solution<dim> &solution, const ElasticSystem<dim> &system, double a);
} // namespace hpvi

#endif
