// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_reduced_problem_h
#define hpvi_reduced_problem_h

#include <hpvi/discretisation/elastic_system.h>
#include <hpvi/solver/linear_solver.h>
#include <hpvi/solver/mprgp.h>

namespace hpvi
{
/** What the solution of the reduced problem brings. */
struct Reduction
{
  dealii::Vector<double> lambda;
  /** The tangential moments B u that S and d promise: `d - S lambda`, and what the translation adds. */
  dealii::Vector<double> moments;
  double translation = 0; ///< length by which a body moves that friction alone holds
  QpReport qp;
  double seconds = 0;          ///< of wall time, for all calls that went on from one another
  double condition_raw = 0;    ///< cond(S), 0 unless the scene asks for it
  double condition_scaled = 0; ///< cond(D^-1/2 S D^-1/2), likewise
};

/**
 * Minimises `1/2 z'Sz - d'z` over the discrete set (3.68) by the scene's solver, from @p start,
 * whose multiplier fits @p contact_space; where friction alone holds the body, under the balance of
 * forces along its free translation. @p defect is added to d: by how much `B u` of a corrected
 * displacement differs from what S and d promised. Throws NumericalFailure where the solver does not
 * converge or where the loads exceed what friction can resist.
 */
template <int dim>
Reduction solve_reduced_problem(const Scene<dim> &scene, const ContactSpace<dim> &contact_space,
                                const ElasticSystem<dim> &system,
                                const SchurComplement &schur_complement,
                                const dealii::Vector<double> &defect, Reduction start);
} // namespace hpvi

#endif
