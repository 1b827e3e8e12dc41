// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cone_program_h
#define hpvi_cone_program_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>
#include <hpvi/solvers/equality_constraints.h>
#include <hpvi/solvers/friction_cones.h>

namespace hpvi
{
/**
 * Find z in its own Tresca set `K(z) = set.at(z)` so that it minimises `1/2 y'Sy - (d + G alpha)'y` over
 * the y of K(z), and `G'z = e`. With the residual `r = S z - d - G alpha`,
 *
 *     r_t = 0 where |z_t| < limit(z_n),   z_t = +-limit(z_n) with -+r_t >= 0 elsewhere,
 *
 * and the other components as in a QuadraticProgram. S is symmetric positive definite and contains, like
 * d, the penalty `G Gamma G'` and `G Gamma e`, as in BalanceSolver. No minimum stands behind this: for
 * large mu there may be several solutions.
 */
struct ConeProgram
{
  dealii::LAPACKFullMatrix<double> S;
  dealii::Vector<double> d;
  FrictionCones set;
  EqualityConstraints balance;        ///< without columns where there are no free motions
  dealii::FullMatrix<double> penalty; ///< Gamma
};
} // namespace hpvi

#endif
