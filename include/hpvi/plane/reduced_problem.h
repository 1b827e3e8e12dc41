// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_reduced_problem_h
#define hpvi_reduced_problem_h

#include <hpvi/plane/discretisation.h>
#include <hpvi/solvers/coulomb_solver.h>

namespace hpvi
{
/** The solution of the reduced problem and what it cost. */
struct ReducedSolution
{
  dealii::Vector<double> z; ///< multiplier [stress]
  /** `B u` less the moments of the gap as S and d promise it: `d - S z`, and what free motions add. */
  dealii::Vector<double> moments;
  dealii::Vector<double> motion; ///< amounts of the free motions that contact sees (RigidMotions)
  QpReport qp;
  CoulombReport coulomb;       ///< of Coulomb friction; its qp is the one above
  double seconds = 0;          ///< of wall time, for all calls that went on from one another
  double condition_raw = 0;    ///< cond(S), 0 unless the scene asks for it
  double condition_scaled = 0; ///< cond(D^-1/2 S D^-1/2), likewise
};

/**
 * Minimises `1/2 z'Sz - d'z` over the feasible set by the scene's solver, from @p start, whose
 * multiplier fits the contact space; where contact alone holds the body, under the balance of forces
 * along its free motions; with Coulomb's law it finds what ConeProgram asks for instead. @p defect is
 * added to d: by how much `B u` of a corrected displacement differs from what S and d promised. Throws NumericalFailure where the solver does not converge or where the
 * loads exceed what contact can resist.
 */
ReducedSolution solve_reduced_problem(const Discretisation<2> &discretisation,
                                      const SchurComplement &schur_complement,
                                      const dealii::Vector<double> &defect, ReducedSolution start);
} // namespace hpvi

#endif
