// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_quadratic_program_h
#define hpvi_quadratic_program_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>
#include <hpvi/solvers/feasible_set.h>

#include <utility>
#include <vector>

namespace hpvi
{
/**
 * `min 1/2 z'Sz - d'z` over a feasible set: the reduced problem (5.7) for the multiplier. A value: S dense
 * symmetric positive definite n x n, d of length n.
 */
struct QuadraticProgram
{
  dealii::LAPACKFullMatrix<double> S;
  dealii::Vector<double> d;
  FeasibleSet feasible_set;

  /** Asserts that S, d, the set and @p z have the same size. */
  void assert_size(const dealii::Vector<double> &z) const;
};

/**
 * `lambda_max / lambda_min` of a dense symmetric matrix: infinity if it is not positive definite to
 * round-off, NaN if the eigenvalues do not exist (NaN in S), one for n = 0. Costs O(n^3).
 */
double condition_number(const dealii::LAPACKFullMatrix<double> &S);

/** Eigenvalues of a small symmetric matrix, the largest first, with their eigenvectors of length 1. */
std::vector<std::pair<double, dealii::Vector<double>>>
eigenpairs(const dealii::FullMatrix<double> &matrix);

/**
 * The factors `S_ii^-1/2` of the diagonal scaling: `z_i = scale_i y_i`. A row whose diagonal is not
 * positive, or so small beside the largest that it is zero to round-off, keeps the factor one.
 */
dealii::Vector<double> diagonal_scale(const dealii::LAPACKFullMatrix<double> &S);

/** `scale_i S_ij scale_j` */
dealii::LAPACKFullMatrix<double> scaled(const dealii::LAPACKFullMatrix<double> &S,
                                        const dealii::Vector<double> &scale);

/** `D^-1/2 S D^-1/2` with D = diag(S); rows whose diagonal vanishes keep the factor one. */
dealii::LAPACKFullMatrix<double> scaled_by_diagonal(const dealii::LAPACKFullMatrix<double> &S);
} // namespace hpvi

#endif
