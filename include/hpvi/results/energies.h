// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_energies_h
#define hpvi_energies_h

#include <hpvi/plane/solution.h>
#include <hpvi/results/field.h>

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

/**
 * What happens while a load step takes the displacement u' and the tractions z', p' of friction and
 * pressure to u, z, p, with du = u - u' [stress length^dim]. In the discrete problem
 *
 *     external = a(u,u)/2 - a(u',u')/2 + dissipated + released + unbalanced
 *
 * up to round-off. `external` is formed from forces at loads and supports, not from stresses at free
 * nodes, and `unbalanced` from what is left there: each says that the body is in equilibrium.
 */
struct Work
{
  /**
   * Mean forces of begin and end times increments, the trapezoidal rule: of loads and of prescribed
   * displacements through their reactions on du, of the foundation, -(p' + p)/2, on the increment of the gap.
   */
  double external = 0;
  double dissipated = 0; ///< int z du_t, of friction
  /**
   * `1/2 int [(z' - z) du_t + (p' + p) d(u_n - u_0)]`: what a smooth path would not lose. It vanishes
   * with the load step, like dt^2 and where bounds change like dt, but where equilibrium jumps.
   */
  double released = 0;
  /** Half of what the forces of the last load step leave on du: zero on its own mesh, not on a finer one. */
  double unbalanced = 0;
  double trapezoidal = 0; ///< `1/2 int (z' + z) du_t`: `dissipated` as `external` is formed
  double initial =
      0; ///< of the stored energy at the end, what initial strains have: initial_energy()
};

/**
 * From @p last to @p next, two solutions of the same mesh and degrees whose scenes may differ in
 * loads, prescribed values, bounds and gaps; @p loads, L(v_i), are those of @p next.
 */
template <int dim>
Work work(const Solution<dim> &last, const Solution<dim> &next,
          const dealii::Vector<double> &loads);

/**
 * From the unloaded body, without displacement or traction, to @p next. A foundation that reaches
 * into the body has come there from its boundary; one at a distance has stood there.
 */
template <int dim>
Work work_from_rest(const Solution<dim> &next, const dealii::Vector<double> &loads);

/**
 * Of a field with @p a = a(u_N,u_N) and @p work = L(u_N). The integral of g |u_Nt| cuts each edge where g jumps
 * or u_Nt changes sign, and each face in space until cutting on changes it by less than 1e-8 of all. Collective.
 */
template <int dim>
Energies energies(const Field<dim> &field, double a, double work);
} // namespace hpvi

#endif
