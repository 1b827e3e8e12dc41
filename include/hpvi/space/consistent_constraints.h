// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_consistent_constraints_h
#define hpvi_consistent_constraints_h

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>

namespace hpvi
{
/**
 * @p constraints, of which each process knows those of its own unknowns @p owned, as all processes agree on them: those of
 * @p relevant unknowns and of all unknowns on which these depend, each as its owner has it, closed. Collective.
 *
 * Does what AffineConstraints::make_consistent_in_parallel() does, whose time grows with the square of the unknowns beside
 * other processes in deal.II 9.4.
 */
void make_consistent(dealii::AffineConstraints<double> &constraints, const dealii::IndexSet &owned,
                     const dealii::IndexSet &relevant, MPI_Comm communicator);
} // namespace hpvi

#endif
